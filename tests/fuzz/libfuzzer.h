// From a target to what libFuzzer calls: a broken promise is printed and ends the program, so that the input is kept.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/fuzz_targets.h"

#define PINTLE_FUZZ_TARGET(target)                                                     \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) { \
    const std::string fault = target({reinterpret_cast<const char*>(bytes), size});    \
    if (!fault.empty()) {                                                              \
      std::fprintf(stderr, "broken promise: %s\n", fault.c_str());                     \
      std::abort();                                                                    \
    }                                                                                  \
    return 0;                                                                          \
  }
