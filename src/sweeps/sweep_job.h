// Everything that the processes and threads of a sweep derive from the request, identical in all of them.
#pragma once

#include <memory>
#include <string>

#include "pintle/sweep.h"
#include "sweeps/batches.h"
#include "sweeps/plan.h"
#include "sweeps/sweep_file.h"

namespace pintle {

class SweepJob {
 public:
  /// Throws InputError with everything that is wrong with model, plan and chosen series.
  explicit SweepJob(const SweepRequest& request);

  const SweepPlan& plan() const { return plan_; }
  /// SHA-256 of all that the results depend on, the program's version among it.
  const std::string& hash() const { return origin_.plan; }
  SweepOrigin origin(const std::string& command) const;
  BatchComputer computer() const { return {plan_, *engine_, *variants_, origin_.check_every}; }

 private:
  SweepPlan plan_;
  std::unique_ptr<EnvelopeEngine> engine_;
  std::unique_ptr<ModelVariants> variants_;
  SweepOrigin origin_;
};

}  // namespace pintle
