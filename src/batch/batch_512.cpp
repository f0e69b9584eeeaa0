// Batches in registers of 512 bits. Code included before the target is set is shared by all and must not be compiled for it.
#include "batch/batch_common.h"

#if PINTLE_BUILDS_512
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")
#define PINTLE_BATCH bits512
#include "batch/batch_lanes.h"
#pragma GCC pop_options
#endif
