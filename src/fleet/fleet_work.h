// The batch computation behind an interface that hides the register width.
#pragma once

#include <memory>
#include <vector>

#include "fleet/fleet.h"

namespace pintle {

class FleetWork {
 public:
  virtual ~FleetWork() = default;
  /// A variant with its assembled positions and velocities into a lane; the system must stay where it is.
  virtual void put(int lane, const System& variant, const Vecs& q, const Vecs& v, double duration) = 0;
  /// All lanes from start to end.
  virtual void run() = 0;
  /// What another sweep would change at the start, relative.
  virtual const Each& unsettled() const = 0;
  /// The largest error estimate of a step over the tolerance; infinite where an iteration has failed or numbers are none.
  virtual const Each& worst() const = 0;
  /// Of the step and lane that took most.
  virtual int iterations() const = 0;
  virtual const std::vector<FleetPeak>& peaks() const = 0;
};

/// With the widest registers that the processor has.
std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan);

// One for each width of registers.
namespace bits128 {
std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan);
}
namespace bits256 {
std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan);
}
namespace bits512 {
std::unique_ptr<FleetWork> make_fleet_work(const FleetPlan& plan);
}

}  // namespace pintle
