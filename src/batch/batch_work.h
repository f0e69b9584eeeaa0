// The batch computation behind an interface that hides the register width.
#pragma once

#include <memory>
#include <vector>

#include "batch/batch.h"

namespace pintle {

class BatchWork {
 public:
  virtual ~BatchWork() = default;
  /// Puts a variant with its assembled positions and velocities into a lane; the system must not be moved afterwards.
  virtual void put(int lane, const System& variant, const Vecs& q, const Vecs& v, double duration) = 0;
  /// Runs all lanes from start to end.
  virtual void run() = 0;
  /// Relative change that another sweep would make at the start.
  virtual const VariantLanes& unsettled() const = 0;
  /// The largest error estimate of a step over the tolerance; infinite if an iteration has failed or a result is not a number.
  virtual const VariantLanes& worst() const = 0;
  /// Iterations of the step and lane that took the most.
  virtual int iterations() const = 0;
  virtual const std::vector<BatchPeak>& peaks() const = 0;
};

/// With the widest registers that the processor has.
std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan);

// One for each width of registers.
namespace bits128 {
std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan);
}
namespace bits256 {
std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan);
}
namespace bits512 {
std::unique_ptr<BatchWork> make_batch_work(const BatchPlan& plan);
}

}  // namespace pintle
