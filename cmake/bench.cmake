# pintle-bench: micro-benchmarks, work-precision curves and the peers, side by side in one program.
pintle_sources(sources ${PROJECT_SOURCE_DIR}/bench)
if(NOT sources)
  message(STATUS "bench/ has no sources: pintle-bench is not built")
  return()
endif()
find_package(benchmark REQUIRED)
add_executable(pintle_bench ${sources})
set_target_properties(pintle_bench PROPERTIES
  OUTPUT_NAME pintle-bench RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
target_compile_definitions(pintle_bench PRIVATE PINTLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_include_directories(pintle_bench PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(pintle_bench PRIVATE pintle_flags pintle_io benchmark::benchmark)
include(cmake/peers.cmake)
