#include "bench/battery/measured_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/stopwatch.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"

namespace pintle::bench {
namespace {

constexpr int kRows = 500;        // rows of a run, as without output_step
constexpr int kBetween = 8;       // rows of the truth per row of a run
constexpr double kNegligible = 1e-4;  // theory/time Eq. (6.1)
constexpr double kGoodTruth = 0.1;    // limit on the truth's error relative to the run's tolerance
constexpr double kLeastRatio = 1.0 / 3, kLargestRatio = 30;

Trajectory run_model(Model model, double tolerance, int rows, double limit) {
  model.simulate.tolerance = tolerance;
  model.simulate.output_step = model.simulate.duration / rows;
  const Stopwatch clock;
  return simulate(model, [&clock, limit](const Progress&) { return clock.seconds() < limit; });
}

// Keeps every kBetween-th row.
Trajectory thinned(const Trajectory& dense) {
  Trajectory out = dense;
  out.values.clear();
  const std::size_t width = dense.columns.size();
  for (std::size_t row = 0; row < dense.n_rows(); row += kBetween)
    out.values.insert(out.values.end(), dense.values.begin() + static_cast<std::ptrdiff_t>(row * width), dense.values.begin() + static_cast<std::ptrdiff_t>((row + 1) * width));
  return out;
}

// Distance of a force from the cubic through the four rows after it.
double off_cubic(const Trajectory& run, std::size_t row, const std::string& prefix) {
  double squares = 0;
  for (const char* component : {"fx[world]", "fy[world]"}) {
    const int c = run.column(prefix + component);
    const auto f = [&](std::size_t i) { return run.at(row + i, static_cast<std::size_t>(c)); };
    squares += std::pow(f(0) - (4 * f(1) - 6 * f(2) + 4 * f(3) - f(4)), 2);
  }
  return std::sqrt(squares);
}

// A start whose forces are not those of the motion is wrong at every tolerance, so a run at a smaller tolerance does not reveal it.
void look_at_start(TrueMotion& truth) {
  constexpr double kSudden = 10, kSeen = 1e-3;
  if (truth.dense.n_rows() < 8) return;
  double largest = 0;
  for (const LoadSummary& joint : truth.dense.joints) largest = std::max(largest, joint.peak);
  for (const LoadSummary& joint : truth.dense.joints) {
    const std::string prefix = "joint." + joint.name + ".on_" + joint.second_body + ".";
    const double usual = std::max(off_cubic(truth.dense, 1, prefix), off_cubic(truth.dense, 2, prefix));
    const double size = off_cubic(truth.dense, 0, prefix) / std::max({joint.peak, kNegligible * largest, 1e-300});
    if (size > kSeen && size > truth.jump_size && size * joint.peak > kSudden * usual) {
      truth.jump = joint.name;
      truth.jump_size = size;
    }
  }
}

// By what factor the ratio of stated to true error is outside the honest range; the true error is uncertain by `doubt`.
double dishonesty(const JointError& e, double doubt) {
  const double least = std::max(e.error - doubt, 1e-300), most = e.error + doubt;
  const double too_small = least * kLeastRatio / std::max(e.estimate, 1e-300), too_large = e.estimate / (kLargestRatio * std::max(most, 1e-300));
  return std::max({1.0, too_small, too_large});
}

void judge(MeasuredRun& out, const std::vector<JointError>& errors, const Trajectory& truth) {
  for (const JointError& e : errors) {
    const auto same = std::find_if(truth.joints.begin(), truth.joints.end(), [&e](const LoadSummary& j) { return j.name == e.joint; });
    const double doubt = same == truth.joints.end() ? 0 : same->relative_error_estimate, off = dishonesty(e, doubt);
    out.honest_joints += off <= 1;
    if (++out.joints > 1 && e.error - doubt <= out.worst.error - out.doubt) continue;
    out.worst = e;
    out.doubt = doubt;
    out.dishonesty = off;
  }
  out.judged = out.joints > 0;
}

}  // namespace

bool MeasuredRun::broke_its_promise() const { return over() && (outcome == Outcome::kCompleted || outcome == Outcome::kHorizon); }

TrueMotion true_motion(const RandomMechanism& mechanism, const BatteryLimits& limits) {
  TrueMotion truth;
  try {
    truth.model = parse_model(mechanism.text, mechanism.name + ".toml");
    truth.dense = run_model(truth.model, limits.truth_tolerance, kRows * kBetween, limits.truth);
  } catch (const std::exception& e) {
    truth.refused = e.what();
    return truth;
  }
  const Outcome o = truth.dense.outcome;
  truth.usable = o == Outcome::kCompleted || o == Outcome::kToleranceNotMet || o == Outcome::kHorizon;
  for (const LoadSummary& joint : truth.dense.joints) truth.error = std::max(truth.error, joint.relative_error_estimate);
  if (truth.usable && !mechanism.kind->touches) look_at_start(truth);
  return truth;
}

// The run has the rows that a user gets, and its stated errors are those that a user sees. If a run with more rows takes the same steps,
// its forces are compared in all of those rows.
MeasuredRun measured_run(const RandomMechanism& mechanism, const TrueMotion& truth, double tolerance, const BatteryLimits& limits) {
  MeasuredRun out;
  out.name = mechanism.name;
  out.kind = mechanism.kind->word;
  out.tolerance = tolerance;
  if (!truth.refused.empty()) {
    out.ended = MeasuredRun::Ended::kRefused;
    out.message = truth.refused;
    return out;
  }
  const Stopwatch clock;
  Trajectory run;
  try {
    run = run_model(truth.model, tolerance, kRows, limits.run);
  } catch (const std::exception& e) {
    out.ended = MeasuredRun::Ended::kThrew;
    out.message = e.what();
    return out;
  }
  out.seconds = clock.seconds();
  out.outcome = run.outcome;
  out.message = run.message;
  out.steps = run.counters.steps;
  out.passes = run.counters.passes;
  if (run.outcome == Outcome::kInterrupted) {
    out.ended = MeasuredRun::Ended::kHung;
    return out;
  }
  const bool finished = run.outcome == Outcome::kCompleted || run.outcome == Outcome::kToleranceNotMet || run.outcome == Outcome::kHorizon;
  if (!finished || !truth.usable || truth.error > kGoodTruth * tolerance) return out;
  Trajectory dense = run_model(truth.model, tolerance, kRows * kBetween, 2 * limits.run);
  if (dense.outcome == run.outcome && dense.counters.steps == run.counters.steps && dense.counters.passes == run.counters.passes) {
    dense.joints = run.joints;
    judge(out, joint_errors(truth.model, dense, truth.dense, kNegligible), truth.dense);
  } else {
    judge(out, joint_errors(truth.model, run, thinned(truth.dense), kNegligible), truth.dense);
  }
  return out;
}

}  // namespace pintle::bench
