#include "tests/fuzz/libfuzzer.h"

PINTLE_FUZZ_TARGET(pintle::fuzz::studio_call)
