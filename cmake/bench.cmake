# pintle-bench: micro-benchmarks, work-precision curves and the peers, side by side in one program.
pintle_sources(sources ${PROJECT_SOURCE_DIR}/bench)
pintle_sources(battery ${PROJECT_SOURCE_DIR}/bench/battery)
if(NOT sources)
  message(STATUS "bench/ has no sources: pintle-bench is not built")
  return()
endif()
find_package(benchmark REQUIRED)
add_executable(pintle_bench ${sources} ${battery})
set_target_properties(pintle_bench PROPERTIES
  OUTPUT_NAME pintle-bench RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
target_compile_definitions(pintle_bench PRIVATE PINTLE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
  PINTLE_BENCH_FLAGS="${CMAKE_CXX_FLAGS_${build_type}} -ffp-contract=off$<$<BOOL:${PINTLE_NATIVE}>: -march=native>")
target_include_directories(pintle_bench PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(pintle_bench PRIVATE pintle_flags pintle_io pintle_batch benchmark::benchmark)
if(TARGET pintle_cli)  # for the instruction counts
  add_dependencies(pintle_bench pintle_cli)
endif()
target_compile_definitions(pintle_bench PRIVATE PINTLE_PROGRAM="${PROJECT_BINARY_DIR}/bin/pintle")
include(cmake/peers.cmake)
