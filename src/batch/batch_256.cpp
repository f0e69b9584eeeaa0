// Batches in registers of 256 bits. Code included before the target is set is shared by all and must not be compiled for it.
#include "batch/batch_common.h"

#if PINTLE_BUILDS_256
#pragma GCC push_options
#pragma GCC target("avx2")
#define PINTLE_BATCH bits256
#include "batch/batch_lanes.h"
#pragma GCC pop_options
#endif
