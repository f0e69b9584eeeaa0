# A room is a folder of src/ and a target pintle_<room>. It may link only to rooms that stand before it in this list.
set(PINTLE_ROOMS base simd space model linalg laws joints system kinematics integrators mobility dynamics start bearings run batch check studies results io report live sweeps)

# Sources of a folder (with RECURSE also of the folders in it) without its tests and what is made for tests; a new file needs no
# edit here.
function(pintle_sources out folder)
  if("RECURSE" IN_LIST ARGN)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  else()
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  endif()
  list(FILTER sources EXCLUDE REGEX "_tests?\\.cpp$")
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# What nearly every source of a room reads is parsed once. Three rooms own what is shared by those after them: space, for linalg to joints;
# system, with the mechanism itself, for integrators to studies and for live; results, for what else is quick to build. No source relies on it: the
# studio's kernel is compiled without.
function(pintle_precompile name quick)
  set(of_space space linalg laws joints)
  if(quick)
    set(owner results)
  elseif(name IN_LIST of_space)
    set(owner space)
  else()
    set(owner system)
  endif()
  if(EMSCRIPTEN OR NOT TARGET pintle_${owner})
    return()
  endif()
  if(owner STREQUAL "system")  # a pass of g++ that takes a fifth of the time of the longest functions, those of lanes, and makes none faster
    target_compile_options(pintle_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-gcse>)
  endif()
  if(NOT owner STREQUAL name)
    target_precompile_headers(pintle_${name} REUSE_FROM pintle_${owner})
    return()
  endif()
  target_precompile_headers(pintle_${name} PRIVATE
    <fmt/format.h> <Eigen/Core> <algorithm> <cmath> <functional> <map> <optional> <string> <variant> <vector>)
  if(owner STREQUAL "system")
    target_precompile_headers(pintle_${name} PRIVATE "${PROJECT_SOURCE_DIR}/src/system/state.h")
  endif()
endfunction()

# With PINTLE_UNITY so many sources of the target as PINTLE_UNITY_SOURCES are compiled as one, so that what they share is read and instantiated
# once. Names in their unnamed namespaces must differ for that. PINTLE_APART has what compiles long by itself, what is slower in company (sampled_curve), catalogs
# and profiles that call the same things alike, classes that are instantiated in several sources or have members of unnamed namespaces, and
# tests in space, whose short names are those of the tests in the plane.
set(PINTLE_APART "(stage_solver_[a-z]*|end_point_projection|dense_forces|batch_[0-9]*|[a-z_]*catalog|tree_augmented|leaf_spring|system|radau_stepper|edge_profile|sampled_curve|sundials_code|limit_notes|blade_basis|(space|spatial)[a-z_]*_test)\\.cpp$")
function(pintle_unite target)
  if(NOT PINTLE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PINTLE_UNITY_SOURCES})
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "${PINTLE_APART}")
  set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# pintle_room(NAME [QUICK] [LINK libraries...]): the target of the current folder, linked to every room on its left. Laws and
# joints do not see each other, and only sweeps see batch, which a program without ensembles need not build. A room without a source is
# a header-only target. QUICK: its speed does not matter.
function(pintle_room name)
  cmake_parse_arguments(arg "QUICK" "" "LINK" ${ARGN})
  pintle_sources(sources ${CMAKE_CURRENT_SOURCE_DIR} RECURSE)
  list(FIND PINTLE_ROOMS ${name} index)
  list(SUBLIST PINTLE_ROOMS 0 ${index} left)
  if(name STREQUAL "joints")
    list(REMOVE_ITEM left laws)
  elseif(NOT name STREQUAL "sweeps")
    list(REMOVE_ITEM left batch)
  endif()
  list(TRANSFORM left PREPEND pintle_)
  if(sources)
    add_library(pintle_${name} STATIC ${sources})
    target_link_libraries(pintle_${name} PUBLIC ${left} ${arg_LINK} PRIVATE pintle_flags)
    if(arg_QUICK AND NOT EMSCRIPTEN)
      target_link_libraries(pintle_${name} PRIVATE pintle_quick_build)
    endif()
    pintle_precompile(${name} ${arg_QUICK})
    pintle_unite(pintle_${name})
  else()
    add_library(pintle_${name} INTERFACE)
    target_link_libraries(pintle_${name} INTERFACE ${left} ${arg_LINK})
  endif()
endfunction()

# The rooms that have compiled sources.
function(pintle_compiled_rooms out)
  set(rooms "")
  foreach(room IN LISTS PINTLE_ROOMS)
    get_target_property(type pintle_${room} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND rooms pintle_${room})
    endif()
  endforeach()
  set(${out} ${rooms} PARENT_SCOPE)
endfunction()
