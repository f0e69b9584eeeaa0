// The code for batches is compiled for registers of 128, 256 and 512 bits: batch_128.cpp and its siblings select the width by PINTLE_BATCH,
// a namespace of their own, and by the compiler's target. The results are bitwise identical.
#pragma once

#include "batch/batch_mechanism.h"

#ifndef PINTLE_BATCH
#error "for batch_128.cpp and its like"
#endif

/// Marks a larger function, which becomes one piece of code with all its calls on lanes and blocks inlined. None takes or returns
/// VariantLanes by value: the conventions for this differ between narrow and wide registers, and g++ 12 does not follow its own.
#define PINTLE_PART [[gnu::noinline, gnu::flatten]]
