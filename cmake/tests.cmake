# Tests. All of them are in one program, pintle_tests; ctest sees one entry per test suite. For work on a single room,
# pintle_<room>_tests holds that room's tests only and compiles nothing on its right.
set(PINTLE_SUITES_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake)

function(pintle_test_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE pintle_flags ${arg_LINK} Eigen3::Eigen GTest::gtest GTest::gtest_main)
  target_compile_options(${name} PRIVATE -O0)  # they are built more often than run
  target_precompile_headers(${name} PRIVATE <gtest/gtest.h> <fmt/format.h> <Eigen/Dense>)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_include_directories(${name} SYSTEM PRIVATE ${PINTLE_TOMLPP_INCLUDE})
  target_compile_definitions(${name} PRIVATE TOML_HEADER_ONLY=1
    PINTLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PINTLE_BINARY="${PROJECT_BINARY_DIR}/bin/pintle")
endfunction()

# One ctest entry per suite, listed by the program itself after each build.
function(pintle_register_suites name)
  set(list ${PROJECT_BINARY_DIR}/${name}_suites.cmake)
  if(NOT EXISTS ${list})
    file(WRITE ${list} "")
  endif()
  add_custom_command(TARGET ${name} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${name}> -DOUTPUT=${list} -DFOLDER=${PROJECT_BINARY_DIR}
            -P ${PINTLE_SUITES_SCRIPT}
    BYPRODUCTS ${list} VERBATIM)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list})
endfunction()

function(pintle_add_tests)
  find_package(GTest REQUIRED)
  set(all "")
  set(samples "")  # what tests of a room and of those on its right use
  foreach(room IN LISTS PINTLE_ROOMS)
    file(GLOB_RECURSE for_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*_for_tests.cpp)
    list(APPEND samples ${for_tests})
    file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*_test.cpp)
    if(tests)
      pintle_test_program(pintle_${room}_tests SOURCES ${tests} ${samples} LINK pintle_${room})
      set_target_properties(pintle_${room}_tests PROPERTIES EXCLUDE_FROM_ALL ON)
      list(APPEND all ${tests})
    endif()
  endforeach()
  file(GLOB tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/*.cpp ${PROJECT_SOURCE_DIR}/cli/*_test.cpp
    ${PROJECT_SOURCE_DIR}/studio/*/*_test.cpp)
  list(APPEND all ${tests})
  if(NOT TARGET pintle_cli)
    list(FILTER all EXCLUDE REGEX "/(cli/[a-z_]*|tests/broken_models)_test\\.cpp$")
  endif()
  if(NOT PINTLE_WHOLE_RUN_TESTS)
    foreach(long IN ITEMS
        "tests/(battery|reference_|relative|published|compare|soft_start|starts|settled_start|stick_slip|held_gas|force_accuracy|motion_accuracy|live|ideal|contact|friction|bearings|state_forces|stops|driven_length|backlash|cams|cylinders|detents|flexures|tables|taut_mechanisms|singular_positions|large_models|space_test|tight_tolerance|belts|gears|penalty|wear|rubber|real_joints|surface_friction|teeth_friction|short_features|starts_without_load)[a-z_]*"
        "integrators/([a-z]+/)?(allocation|alpha_stepper|dense_output|dopri5|event_crossing|methods|penalty|radau_[a-z]*|stage_solver)_test"
        "(run/simulate|start/assembly|start/start)_test" "system/system_test"
        "(laws/flexures/(leaf_spring|pivots)|integrators/relative/tree_methods|linalg/block_pattern|batch/envelope|report/scene|check/check_[a-z_]*)_test"
        "cli/(check|solvers|stopped_run)_test")
      list(FILTER all EXCLUDE REGEX "/${long}\\.cpp$")
    endforeach()
  endif()
  if(NOT all)
    return()
  endif()
  if("${PROJECT_SOURCE_DIR}/tests/battery_test.cpp" IN_LIST all)  # its mechanisms are those of pintle-bench
    file(GLOB battery CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/battery/*.cpp)
    list(APPEND all ${battery} ${PROJECT_SOURCE_DIR}/bench/joint_errors.cpp)
  endif()
  list(APPEND all ${samples})
  pintle_test_program(pintle_tests SOURCES ${all} LINK $<TARGET_NAME_IF_EXISTS:pintle_verbs> pintle_report pintle_sweeps pintle_studio_server)
  target_precompile_headers(pintle_tests PRIVATE "${PROJECT_SOURCE_DIR}/src/system/state.h")
  pintle_unite(pintle_tests)
  if(PINTLE_UNITY)
    set_target_properties(pintle_tests PROPERTIES UNITY_BUILD_BATCH_SIZE 9)
  endif()
  # Inline functions are in many objects, and the linker takes the first: those of the library, which are optimized, and not those of the tests.
  set(rooms "")
  foreach(room IN LISTS PINTLE_ROOMS)
    if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
      continue()
    endif()
    get_target_property(type pintle_${room} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      string(APPEND rooms ",$<TARGET_FILE:pintle_${room}>")
    endif()
  endforeach()
  if(rooms)
    target_link_options(pintle_tests PRIVATE "LINKER:--whole-archive${rooms},--no-whole-archive")
  endif()
  if(TARGET pintle_cli)
    add_dependencies(pintle_tests pintle_cli pintle_sweep_cli pintle_pictures_cli)
    if(TARGET pintle_studio_cli)
      add_dependencies(pintle_tests pintle_studio_cli)
    endif()
  endif()
  pintle_register_suites(pintle_tests)
endfunction()

# tests/fuzz/<name>_fuzz.cpp becomes <name>_fuzz.
function(pintle_add_fuzzers)
  file(GLOB fuzzers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/fuzz/*_fuzz.cpp)
  foreach(source IN LISTS fuzzers)
    get_filename_component(name ${source} NAME_WE)
    add_executable(${name} ${source})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE pintle_flags pintle_io pintle_studio_server)
    target_link_options(${name} PRIVATE -fsanitize=fuzzer)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/fuzz)
  endforeach()
endfunction()
