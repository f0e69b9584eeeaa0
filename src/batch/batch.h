// Variants similar to their base, in batches of eight in register lanes: start, steps of the base's lengths, peaks of
// the joint forces. A variant that does not qualify, or would need shorter steps, reports it and is left to `simulate_reduced`.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "batch/batch_mechanism.h"
#include "integrators/load_scale.h"
#include "run/nominal_run.h"

namespace pintle {

/// How the base is integrated, and with it the variants.
struct BatchPlan {
  System base;
  double duration = 0, max_step = 0;                   // [s]
  double wanted = 0;                                   // tolerance of the forces
  double tolerance = 0, of_newton = 0;                 // of the steps, of the iterations in them
  double most_error = 0;                               // upper limit on the error of a variant's steps, relative to their tolerance
  double span = 0;                                     // time over which the joints are smooth at the start, as a fraction of the duration
  int sweeps = 2;                                      // over their motion there
  double slack = 1;                                    // factor by which the base's joints may be slower without being soft
  LoadScale scale;
  std::vector<double> steps;                           // fractions of the duration
};

/// Empty if `base` or its start is of a kind that a batch does not accept, or if its batch's peaks are not those of `run`, the
/// checked run from which the nominal settings are.
std::optional<BatchPlan> plan_batch(const Model& base, const NominalRun& nominal, const Trajectory& run);

struct BatchResult {
  bool good = false;  // otherwise the rest is meaningless
  double unsettled = 0;  // relative change that another sweep would make at the start
  double error = 0;   // the largest of any step, relative to the tolerance of steps
  int iterations = 0;  // of the step that took the most, in this lane or another
  struct Peak {
    double force = 0, time = 0, couple = 0;  // [N], [s], [N*m]
  };
  std::vector<Peak> joints;
};

class BatchWork;

class Batch {
 public:
  explicit Batch(const BatchPlan& plan);
  ~Batch();

  /// Whether the plan is suitable for this variant at all.
  bool accepts(const Model& variant) const;
  /// Assembles a variant into a lane. Returns false if it is not suitable for a batch. Throws AssemblyError.
  bool put(int lane, const Model& variant);
  /// Runs all lanes that have been filled since the last call.
  std::array<BatchResult, kVariantLanes> run();

 private:
  bool is_like_base(const System& variant) const;

  const BatchPlan& plan_;
  std::array<System, kVariantLanes> variant_;
  std::unique_ptr<BatchWork> work_;
  std::array<bool, kVariantLanes> filled_{};
};

/// Batches of one plan for any number of threads: making one takes as long as running it.
class BatchPool {
 public:
  explicit BatchPool(BatchPlan plan) : plan_(std::move(plan)) {}
  const BatchPlan& plan() const { return plan_; }
  std::unique_ptr<Batch> borrow();
  void give_back(std::unique_ptr<Batch> batch);

 private:
  const BatchPlan plan_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Batch>> idle_;
};

}  // namespace pintle
