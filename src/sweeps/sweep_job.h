// Everything that the processes and threads of a sweep derive from the request; identical in all of them.
#pragma once

#include <memory>
#include <string>

#include "pintle/sweep.h"
#include "sweeps/chunks.h"
#include "sweeps/plan.h"
#include "sweeps/storage/sweep_file.h"

namespace pintle {

class SweepJob {
 public:
  /// Throws InputError with everything that is wrong with the model, the plan and the chosen series.
  explicit SweepJob(const SweepRequest& request);

  const SweepPlan& plan() const { return plan_; }
  /// SHA-256 of everything that the results depend on, including the program's version.
  const std::string& hash() const { return origin_.plan; }
  SweepOrigin origin(const std::string& command) const;
  std::uint64_t samples_per_chunk() const { return pintle::samples_per_chunk(origin_.check_every); }
  ChunkComputer computer() const { return {plan_, *engine_, *variants_, origin_.check_every}; }

 private:
  SweepPlan plan_;
  std::unique_ptr<EnvelopeEngine> engine_;
  std::unique_ptr<ModelVariants> variants_;
  SweepOrigin origin_;
};

}  // namespace pintle
