// Envelopes of the joint forces of many variants of one mechanism: the interface of ensembles to the integrators.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "pintle/model.h"
#include "pintle/sweep.h"
#include "run/nominal_run.h"

namespace pintle {

/// One variant: the base model with other numbers in it. Names, types and their order are those of the base.
struct Variant {
  Model model;
  bool checked = true;  ///< its errors are estimated and the tolerance is met, as by `simulate`; otherwise one integration
};

/// The largest force of a joint over a run.
struct JointPeak {
  double force = 0;   ///< magnitude [N]
  double time = 0;    ///< of the largest force [s]
  double moment = 0;  ///< largest couple [N*m]; 0 if the joint transmits none
  double error = 0;   ///< estimated, of any component over the run; NaN: not estimated
};

struct SampleResult {
  SampleStatus status = SampleStatus::kCompleted;
  std::uint64_t steps = 0, passes = 0;
  bool in_batch = false;          ///< run with others in register lanes
  std::vector<JointPeak> joints;  ///< in the order of the model; empty if it could not be started
  std::vector<double> series;     ///< the chosen columns one after the other, each at all output times; NaN at times that were not reached
  std::string message;            ///< why it was not completed
};

struct EnvelopeRequest {
  std::vector<std::string> series;  ///< names of columns as in series.csv
  bool unchecked = false;           ///< some variants will not be checked: the base is run once to find out how to integrate them
  bool batches = true;              ///< variants may be run in batches; otherwise each in a run of its own
};

class EnvelopeEngine {
 public:
  /// Throws std::invalid_argument for a column that `base` does not have.
  EnvelopeEngine(const Model& base, EnvelopeRequest request);

  /// One result per variant, in order. A variant's result depends only on that variant and the base, not on its neighbours.
  /// Empty if `keep_going`, which is called now and then, returns false.
  std::vector<SampleResult> run(std::span<const Variant> variants, const std::function<bool()>& keep_going) const;

  const std::vector<std::string>& joints() const { return joints_; }
  double output_step() const { return output_step_; }  // [s]
  std::size_t n_times() const { return n_times_; }
  const std::vector<std::string>& series_units() const { return units_; }

 private:
  void run_nominal(const Model& base);
  SampleResult run_alone(const Variant& variant, const Observer& observer) const;
  SampleResult of_batch(const BatchResult& result) const;

  EnvelopeRequest request_;
  std::vector<std::string> joints_, units_;
  std::vector<int> columns_;
  double output_step_ = 0;
  std::size_t n_times_ = 0;
  NominalRun nominal_;  // of the base
  std::shared_ptr<BatchPool> batches_;  // null: the base is not for batches
};

}  // namespace pintle
