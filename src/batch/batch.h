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
  double most_error = 0;                               // of a variant's steps, over their tolerance
  double span = 0;                                     // over which the joints are smooth at the start, of the duration
  int sweeps = 2;                                      // of their motion there
  double slack = 1;                                    // the base's joints may be so much slower without being soft
  LoadScale scale;
  std::vector<double> steps;                           // shares of the duration
};

/// None where `base` is of a kind, or has a start, that a batch does not take, or where its batch's peaks are not those of `run`, the
/// checked run that the nominal settings are from.
std::optional<BatchPlan> plan_batch(const Model& base, const NominalRun& nominal, const Trajectory& run);

struct BatchResult {
  bool good = false;  // otherwise the rest says nothing
  double unsettled = 0;  // what another sweep would change at the start, relative
  double error = 0;   // the largest of a step, over the tolerance of steps
  int iterations = 0;  // of the step that took most, in this lane or another
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

  /// Whether the plan can serve this variant at all.
  bool accepts(const Model& variant) const;
  /// Assembles a variant into a lane. False where that is not one for a batch. Throws AssemblyError.
  bool put(int lane, const Model& variant);
  /// All lanes that something was put into since the last time.
  std::array<BatchResult, kVariantLanes> run();

 private:
  bool is_like_base(const System& variant) const;

  const BatchPlan& plan_;
  std::array<System, kVariantLanes> variant_;
  std::unique_ptr<BatchWork> work_;
  std::array<bool, kVariantLanes> filled_{};
};

/// Batches of one plan for as many threads as ask: to make one takes as long as to run it.
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
