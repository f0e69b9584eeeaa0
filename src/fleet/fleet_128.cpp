// Fleets in registers that every processor has; and the choice between these and wider ones.
#define PINTLE_FLEET bits128
#include "fleet/fleet_lanes.h"
#include "simd/wide.h"

namespace pintle {

std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan) {
#ifdef PINTLE_WIDE
  if (has_widest_registers()) return bits512::make_fleet_work(plan);
  if (has_wide_registers()) return bits256::make_fleet_work(plan);
#endif
  return bits128::make_fleet_work(plan);
}

}  // namespace pintle
