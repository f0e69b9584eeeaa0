// What works on batches is compiled for registers of 128, 256 and 512 bits: batch_128.cpp and its like say which with PINTLE_BATCH, a
// namespace of their own, and the compiler's target. The bits of the results are the same.
#pragma once

#include "batch/batch_mechanism.h"

#ifndef PINTLE_BATCH
#error "for batch_128.cpp and its like"
#endif

/// Before a function of some size: one piece of code, into which all that it calls of lanes and blocks is inlined. None takes or gives
/// VariantLanes by value: code for narrow and for wide registers disagrees on how that is done, and g++ 12 with itself.
#define PINTLE_PART [[gnu::noinline, gnu::flatten]]
