#include "batch/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "base/text/did_you_mean.h"
#include "run/pass_constants.h"
#include "run/recorder.h"
#include "system/build.h"

namespace pintle {
namespace {

constexpr double kNotEstimated = std::numeric_limits<double>::quiet_NaN();

SampleStatus status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kCompleted:
      return SampleStatus::kCompleted;
    case Outcome::kToleranceNotMet:
      return SampleStatus::kToleranceNotMet;
    case Outcome::kHorizon:
      return SampleStatus::kHorizon;
    case Outcome::kRunaway:
      return SampleStatus::kRunaway;
    case Outcome::kEnergyOpen:
      return SampleStatus::kEnergyOpen;
    default:
      return SampleStatus::kFailed;
  }
}

SampleResult result_of(const Trajectory& run, bool checked) {
  SampleResult out;
  out.status = status_of(run.outcome);
  out.message = run.message;
  out.steps = run.counters.steps;
  out.passes = run.counters.passes;
  // There is no estimate without a second integration, even if a checked run broke off before it, nor for a chaotic motion after its horizon.
  const bool estimated = checked && run.counters.passes > 1;
  out.joints.reserve(run.joints.size());
  for (const LoadSummary& joint : run.joints) {
    const bool promised = estimated && !(run.outcome == Outcome::kHorizon && joint.peak_time > joint.horizon);
    out.joints.push_back({joint.peak, joint.peak_time, joint.peak_moment, promised ? joint.error_estimate : kNotEstimated});
  }
  return out;
}

void copy_series(const Trajectory& run, const std::vector<int>& columns, std::size_t n_times, std::vector<double>& out) {
  out.assign(columns.size() * n_times, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (std::size_t i = 0; i < std::min(n_times, run.n_rows()); ++i) out[k * n_times + i] = run.at(i, static_cast<std::size_t>(columns[k]));
}

// How many rows a run records.
std::size_t output_rows(double duration, double step) {
  const double almost = duration * kAlmostAll;
  std::size_t row = static_cast<std::size_t>(almost / step);  // the last row before the end, or its neighbour
  while (row > 0 && static_cast<double>(row) * step >= almost) --row;
  while (static_cast<double>(row + 1) * step < almost) ++row;
  return row + 2;
}

// A variant that cannot be assembled is not for a batch either: a run of its own reports why.
bool board(Batch& batch, int lane, const Model& variant) {
  try {
    return batch.accepts(variant) && batch.put(lane, variant);
  } catch (const AssemblyError&) {
    return false;
  }
}

}  // namespace

EnvelopeEngine::EnvelopeEngine(const Model& base, EnvelopeRequest request) : request_(std::move(request)) {
  const System system = build_system(base);
  output_step_ = output_step_of(base.simulate, system.joints.size());
  n_times_ = output_rows(base.simulate.duration, output_step_);
  for (const JointData& joint : system.joints)
    if (joint.servo < 0) joints_.push_back(joint.name);
  const Recorder recorder(base, system);
  const std::vector<Column>& columns = recorder.columns();
  for (const std::string& name : request_.series) {
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
    if (found == columns.end()) {
      std::vector<std::string> names;
      for (const Column& column : columns) names.push_back(column.name);
      const auto near = did_you_mean(name, names);
      throw std::invalid_argument(fmt::format("a run has no column \"{}\"; {}", name,
                                              near ? "did you mean " + *near + "?" : "the first row of a run's series.csv lists them"));
    }
    columns_.push_back(static_cast<int>(found - columns.begin()));
    units_.push_back(found->unit);
  }
  if (request_.unchecked) run_nominal(base);
}

// A base that cannot be run gives no settings; its variants may still run.
void EnvelopeEngine::run_nominal(const Model& base) {
  try {
    const Trajectory run = simulate_reduced(base, {Recorded::kForces, true, nullptr, &nominal_});
    if (!request_.batches || !request_.series.empty() || run.outcome != Outcome::kCompleted) return;
    if (auto plan = plan_batch(base, nominal_, run)) batches_ = std::make_shared<BatchPool>(std::move(*plan));
  } catch (const AssemblyError&) {
    nominal_ = {};
  }
}

SampleResult EnvelopeEngine::run_alone(const Variant& variant, const Observer& observer) const {
  const RunShape shape{columns_.empty() ? Recorded::kForces : Recorded::kColumns, variant.checked, &nominal_, nullptr};
  try {
    const Trajectory run = simulate_reduced(variant.model, shape, observer);
    SampleResult out = result_of(run, variant.checked);
    if (!columns_.empty()) copy_series(run, columns_, n_times_, out.series);
    return out;
  } catch (const AssemblyError& error) {
    SampleResult refused;
    refused.status = SampleStatus::kNotAssembled;
    refused.message = error.what();
    return refused;
  }
}

SampleResult EnvelopeEngine::of_batch(const BatchResult& result) const {
  SampleResult out;
  out.steps = batches_->plan().steps.size();
  out.passes = 1;
  out.in_batch = true;
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    const JointData& joint = batches_->plan().base.joints[j];
    if (joint.servo >= 0) continue;
    const BatchResult::Peak& peak = result.joints[j];
    out.joints.push_back({peak.force, peak.time, transmits_couple(joint) ? peak.couple : 0, kNotEstimated});
  }
  return out;
}

// Unchecked variants are run in batches as far as possible, the others one by one.
std::vector<SampleResult> EnvelopeEngine::run(std::span<const Variant> variants, const std::function<bool()>& keep_going) const {
  std::vector<SampleResult> out(variants.size());
  bool stopped = false;
  const Observer observer = [&](const Progress&) { return !(stopped = !keep_going()); };
  std::unique_ptr<Batch> batch = batches_ ? batches_->borrow() : nullptr;
  std::vector<std::size_t> aboard;  // by lane
  std::vector<std::size_t> alone;
  const auto sail = [&] {
    const auto results = batch->run();
    for (std::size_t lane = 0; lane < aboard.size(); ++lane)
      if (results[lane].good) out[aboard[lane]] = of_batch(results[lane]);
      else alone.push_back(aboard[lane]);
    aboard.clear();
  };
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (!keep_going()) return {};
    if (variants[i].checked || !batch || !board(*batch, static_cast<int>(aboard.size()), variants[i].model)) {
      alone.push_back(i);
      continue;
    }
    aboard.push_back(i);
    if (aboard.size() == kVariantLanes) sail();
  }
  if (!aboard.empty()) sail();
  if (batch) batches_->give_back(std::move(batch));
  for (const std::size_t i : alone) {
    if (!keep_going()) return {};
    out[i] = run_alone(variants[i], observer);
    if (stopped) return {};
  }
  return out;
}

}  // namespace pintle
