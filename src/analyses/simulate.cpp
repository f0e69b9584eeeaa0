// A run: assemble, integrate twice with different tolerances, compare the joint forces of the two, tighten until the
// difference says that the tolerance is met. theory/time section 6.
#include "pintle/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "analyses/integration.h"
#include "analyses/start.h"
#include "system/build.h"

namespace pintle {
namespace {

constexpr int kMaxPasses = 6;
constexpr double kTighten = 0.1;        // tolerance of a pass over that of the one before
constexpr double kShareOfDifference = 1.0 / 3;  // of |pass - pass before| that is stated as the error of the finer one

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Largest difference of each joint's force (and couple) between two passes, and the peaks of the finer one.
struct Comparison {
  std::vector<double> force, couple, peak, peak_couple;
};

Comparison compare(const ForceTable& coarse, const ForceTable& fine, std::size_t joints) {
  Comparison c;
  for (auto* x : {&c.force, &c.couple, &c.peak, &c.peak_couple}) x->assign(joints, 0.0);
  const std::size_t rows = std::min(coarse.t.size(), fine.t.size());
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < joints; ++j) {
      const double *a = &coarse.world[3 * (i * joints + j)], *b = &fine.world[3 * (i * joints + j)];
      c.peak[j] = std::max(c.peak[j], std::hypot(b[0], b[1]));
      c.peak_couple[j] = std::max(c.peak_couple[j], std::abs(b[2]));
      if (coarse.t[i] != fine.t[i]) continue;
      c.force[j] = std::max(c.force[j], std::hypot(a[0] - b[0], a[1] - b[1]));
      c.couple[j] = std::max(c.couple[j], std::abs(a[2] - b[2]));
    }
  return c;
}

double relative(double error, double peak, double largest) { return error / std::max({peak, 1e-6 * largest, 1e-300}); }

// The largest error estimate of any joint over its peak force; joints that carry next to nothing are measured by the
// millionth part of the largest force of the mechanism.
double worst(const Comparison& c) {
  const double largest = c.peak.empty() ? 0 : *std::max_element(c.peak.begin(), c.peak.end());
  double ratio = 0;
  for (std::size_t j = 0; j < c.force.size(); ++j)
    ratio = std::max(ratio, kShareOfDifference * relative(c.force[j], c.peak[j], largest));
  return ratio;
}

class Run {
 public:
  Run(const Model& model, const Observer& observer) : model_(model), observer_(observer) {}

  Trajectory go() {
    system_ = build_system(model_);
    Assembly assembly = start_of_run(model_, system_);
    start_ = std::move(assembly.state);
    out_.notes = std::move(assembly.notes);
    out_.tolerance = model_.simulate.tolerance;
    explicit_ = model_.simulate.method == "dopri5";
    out_.method = explicit_ ? "dopri5" : "radau";
    integrate();
    out_.wall_seconds = clock_.seconds();
    return std::move(out_);
  }

 private:
  IntegrationPlan plan(double tolerance) {
    IntegrationPlan p;
    p.duration = model_.simulate.duration;
    p.output_step = model_.simulate.output_step > 0 ? model_.simulate.output_step : p.duration / 500;
    p.max_step = model_.simulate.max_step;
    p.tolerance = tolerance;
    p.first_step = 1e-4 * p.duration;
    if (!last_.scale.body.empty()) p.scale = &last_.scale;
    p.keep_going = [this](double t) { return report(t); };
    return p;
  }

  bool report(double t) {
    const double now = clock_.seconds();
    if (!observer_ || now - reported_ < 0.1) return true;
    reported_ = now;
    return observer_({t, model_.simulate.duration, static_cast<int>(out_.counters.passes) + 1, now});
  }

  void run_pass(double tolerance) {
    coarse_ = std::move(fine_);
    fine_ = std::make_unique<Recorder>(model_, system_);
    const IntegrationPlan p = plan(tolerance);
    Integration done = explicit_ ? integrate_dopri5(system_, start_, p, *fine_) : integrate_radau(system_, start_, p, *fine_);
    Counters& c = out_.counters;
    c.steps += done.counters.steps;
    c.rejected += done.counters.rejected;
    c.newton_iterations += done.counters.newton_iterations;
    c.newton_failures += done.counters.newton_failures;
    c.evaluations += done.counters.evaluations;
    c.factorizations += done.counters.factorizations;
    ++c.passes;
    if (last_scale_kept_) done.scale = last_.scale;
    last_ = std::move(done);
    last_scale_kept_ = last_.ended == Ended::kAtEnd;
  }

  void integrate() {
    const double wanted = model_.simulate.tolerance;
    double tolerance = wanted;
    run_pass(tolerance);
    Comparison difference;
    double error = 0;
    while (last_.ended == Ended::kAtEnd) {
      tolerance *= kTighten;
      run_pass(tolerance);
      difference = compare(coarse_->forces(), fine_->forces(), system_.joints.size());
      error = worst(difference);
      if (error <= wanted || out_.counters.passes >= kMaxPasses || tolerance < 1e-13) break;
    }
    finish(difference, error);
  }

  void finish(const Comparison& difference, double error) {
    fine_->fill(out_);
    out_.t_end = last_.t;
    out_.message = last_.message;
    const double largest = difference.peak.empty() ? 0 : *std::max_element(difference.peak.begin(), difference.peak.end());
    std::size_t row = 0;
    for (std::size_t j = 0; j < system_.joints.size(); ++j) {
      if (system_.joints[j].servo >= 0) continue;
      LoadSummary& joint = out_.joints[row++];
      if (difference.force.empty()) continue;
      joint.error_estimate = kShareOfDifference * difference.force[j];
      joint.relative_error_estimate = relative(joint.error_estimate, difference.peak[j], largest);
    }
    if (last_.ended == Ended::kFailed) out_.outcome = Outcome::kFailed;
    else if (last_.ended == Ended::kStopped) out_.outcome = Outcome::kInterrupted;
    else if (error > model_.simulate.tolerance) out_.outcome = Outcome::kToleranceNotMet;
    if (difference.force.empty()) out_.notes.push_back("stopped before a second integration: the joint forces carry no error estimate");
    if (out_.outcome == Outcome::kToleranceNotMet)
      out_.message = fmt::format("the largest joint-force error is estimated at {:.2g} of the joint's peak force, {:.2g} was asked for", error,
                                 model_.simulate.tolerance);
  }

  const Model& model_;
  const Observer& observer_;
  Clock clock_;
  System system_;
  State start_;
  Trajectory out_;
  bool explicit_ = false, last_scale_kept_ = false;
  std::unique_ptr<Recorder> coarse_, fine_;
  Integration last_;
  double reported_ = 0;
};

}  // namespace

Trajectory simulate(const Model& model, const Observer& observer) { return Run(model, observer).go(); }

}  // namespace pintle
