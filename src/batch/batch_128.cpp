// Batches in registers that every processor has, and the choice between these and wider ones.
#include "batch/batch_work.h"
#include "simd/processor_registers.h"

#if PINTLE_BUILDS_128
#define PINTLE_BATCH bits128
#include "batch/batch_lanes.h"
#endif

namespace pintle {

std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan) {
  if constexpr (PINTLE_BUILDS_512)
    if (has_widest_registers()) return bits512::make_batch_work(plan);
  if constexpr (PINTLE_BUILDS_256)
    if (has_wide_registers()) return bits256::make_batch_work(plan);
  if constexpr (PINTLE_BUILDS_128) return bits128::make_batch_work(plan);
  else refuse_processor();
}

}  // namespace pintle
