# What the kernel needs when it is built for the browser (emcmake cmake): the header-only libraries, and nothing else of the
# host's headers.
set(PINTLE_WEB_INCLUDE ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${PINTLE_WEB_INCLUDE})
foreach(library eigen3/Eigen fmt nlohmann toml++)
  get_filename_component(name ${library} NAME)
  if(NOT EXISTS /usr/include/${library})
    message(FATAL_ERROR "/usr/include/${library} is missing (tools/setup.sh build)")
  endif()
  file(CREATE_LINK /usr/include/${library} ${PINTLE_WEB_INCLUDE}/${name} SYMBOLIC)
endforeach()
foreach(target Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${PINTLE_WEB_INCLUDE})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY=1)
set(PINTLE_TOMLPP_INCLUDE ${PINTLE_WEB_INCLUDE})
set(PINTLE_SUNDIALS_LIBRARIES "")
list(REMOVE_ITEM PINTLE_ROOMS batch sweeps)  # ensembles: threads and files

# Exceptions of WebAssembly itself: those by way of JavaScript cost every call of the innermost loops.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)
