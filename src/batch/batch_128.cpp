// Batches in registers that every processor has, and the choice between these and wider ones.
#define PINTLE_BATCH bits128
#include "batch/batch_lanes.h"
#include "simd/processor_registers.h"

namespace pintle {

std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan) {
#ifdef PINTLE_WIDE
  if (has_widest_registers()) return bits512::make_batch_work(plan);
  if (has_wide_registers()) return bits256::make_batch_work(plan);
#endif
  return bits128::make_batch_work(plan);
}

}  // namespace pintle
