# What every translation unit of Pintle is compiled with. The target is linked PRIVATE and never installed.
add_library(pintle_flags INTERFACE)
target_compile_features(pintle_flags INTERFACE cxx_std_20)
target_include_directories(pintle_flags INTERFACE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(pintle_flags INTERFACE PINTLE_VERSION="${PROJECT_VERSION}")
target_compile_options(pintle_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow
  -ffp-contract=off)  # the same bits from every compiler that keeps to IEEE 754
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(pintle_flags INTERFACE  # false alarms on std::string in g++ 12 and 13
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # memory up to 512 MB is not searched for what could be freed: a tenth of the time
  target_compile_options(pintle_flags INTERFACE "SHELL:--param ggc-min-heapsize=524288")
endif()
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(pintle_flags INTERFACE -Wno-psabi)  # lanes wider than the registers are never passed: they are inlined
endif()
if(NOT PINTLE_SPACE)
  target_compile_definitions(pintle_flags INTERFACE PINTLE_PLANAR_ONLY=1)
endif()
if(PINTLE_REGISTERS STREQUAL "HOST" AND NOT EMSCRIPTEN)
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx512f\") && __builtin_cpu_supports(\"avx512dq\") && __builtin_cpu_supports(\"avx512vl\") ? 0 : 1; }" PINTLE_HOST_HAS_512)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") ? 0 : 1; }" PINTLE_HOST_HAS_256)
  target_compile_definitions(pintle_flags INTERFACE PINTLE_REGISTERS=$<IF:$<BOOL:${PINTLE_HOST_HAS_512}>,512,$<IF:$<BOOL:${PINTLE_HOST_HAS_256}>,256,128>>)
endif()
if(PINTLE_WERROR)
  target_compile_options(pintle_flags INTERFACE -Werror)
endif()
if(PINTLE_NATIVE)
  target_compile_options(pintle_flags INTERFACE -march=native)
endif()
if(PINTLE_SANITIZE)
  target_compile_options(pintle_flags INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")  # Eigen checks its own indices; the sanitizers' checks of it double the time to build
    target_compile_options(pintle_flags INTERFACE -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/unsanitized.txt)
  endif()
  target_compile_definitions(pintle_flags INTERFACE _GLIBCXX_ASSERTIONS PINTLE_SANITIZED=1)
  target_link_options(pintle_flags INTERFACE -fsanitize=address,undefined)
endif()
if(PINTLE_FUZZ)
  target_compile_options(pintle_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# For code whose speed does not matter: quick to build even in Release.
add_library(pintle_quick_build INTERFACE)
target_compile_options(pintle_quick_build INTERFACE $<$<CONFIG:Release>:-O1> $<$<CONFIG:Debug>:-O0>)
