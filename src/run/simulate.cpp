// A run: assemble, integrate twice with different tolerances, compare the joint forces of the two, tighten until the
// difference says that the tolerance is met. theory/time section 6.
#include "pintle/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_set>
#include <utility>

#include "base/stopwatch.h"
#include "run/integration.h"
#include "run/nominal_run.h"
#include "run/passes.h"
#include "start/start.h"
#include "system/build.h"

namespace pintle {
namespace {

constexpr int kMaxPasses = 6;
constexpr double kLoosest = 1e-4;   // of the second pass: above it steps are bounded by other things, and two passes are alike
constexpr double kLoosestIdeal = 1e-8;  // ideal joints are a reference, and cheap
constexpr double kLoosestOfMotion = 1e-3;
constexpr double kLeastTolerance = 1e-13;
// The error of the finer of two passes over their difference: falls as the tolerances' ratio to this power, from here.
constexpr double kSharePower = 0.8, kShareOfEqual = 3;
constexpr double kPromised = 0.7;  // of the tolerance: with a smaller stated error the true one keeps to it, which may be a third larger
constexpr double kAlike = 1.25;  // steps of the finer pass over those of the coarser: with fewer the two say little
constexpr double kSurest = 0.1;  // of the tolerance of the steps: no error of the motion is stated as smaller
constexpr std::size_t kManyBodies = 1000;
constexpr double kNegligible = 1e-4;         // a joint is measured at least by this part of the mechanism's largest force
constexpr double kNegligibleOfMotor = 1e-3;  // a motor by this

// Largest difference of each joint's force (and couple) between two passes, and the peaks of the finer one.
struct PassDifference {
  std::vector<double> force, couple, peak, peak_couple;
};

PassDifference difference_of_passes(const ForceTable& coarse, const ForceTable& fine, std::size_t joints) {
  PassDifference c;
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

double distance(const double* a, const double* b, double radius) {
  return std::max(std::hypot(a[0] - b[0], a[1] - b[1]), 2 * radius * std::abs(std::sin(0.5 * (a[2] - b[2]))));
}

// Largest difference of a body's place between two passes, over the longest way that one has gone from its start; of centres
// and of points at the radius of gyration. theory/time Eq. (6.4).
double motion_difference(const System& system, const ForceTable& coarse, const ForceTable& fine) {
  const std::size_t bodies = system.bodies.size(), rows = std::min(coarse.t.size(), fine.t.size());
  double difference = 0, way = 0;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < bodies; ++i) {
      const double radius = system.bodies[i].radius_of_gyration();
      const double* here = &fine.place[3 * (row * bodies + i)];
      way = std::max(way, distance(here, &fine.place[3 * i], radius));
      if (coarse.t[row] == fine.t[row]) difference = std::max(difference, distance(here, &coarse.place[3 * (row * bodies + i)], radius));
    }
  return way > 0 ? difference / way : 0;
}

double relative(double error, double peak, double least) { return error / std::max({peak, least, 1e-300}); }

double largest_of(const std::vector<double>& x) { return x.empty() ? 0 : *std::max_element(x.begin(), x.end()); }

class Run {
 public:
  Run(const Model& model, const Observer& observer, const RunShape& shape) : model_(model), observer_(observer), shape_(shape) {}

  Trajectory go() {
    announce_assembly();
    system_ = build_system(model_);
    Assembly assembly = start_of_run(model_, system_, shape_.nominal != nullptr && !shape_.checked ? shape_.nominal->span : 0);
    start_ = std::move(assembly.state);
    span_ = assembly.span;
    out_.notes = std::move(assembly.notes);
    not_unique_ = std::move(assembly.not_unique);
    out_.tolerance = model_.simulate.tolerance;
    choice_.equations = model_.simulate.equations;
    choice_.method = model_.simulate.method == "auto" ? usual_method(choice_.equations) : model_.simulate.method;
    out_.method = choice_.method;
    choice_.tolerance_of = model_.simulate.tolerance_of;
    out_.of_motion = choice_.tolerance_of == ToleranceOf::kMotion;
    make_passes();
    out_.wall_seconds = clock_.seconds();
    return std::move(out_);
  }

 private:
  IntegrationPlan plan(double tolerance) {
    IntegrationPlan p;
    p.duration = model_.simulate.duration;
    p.output_step = output_step_of(model_.simulate, system_.joints.size());
    p.max_step = model_.simulate.max_step;
    p.tolerance = tolerance;
    p.choice = choice_;
    p.first_step = 1e-4 * p.duration;
    if (!last_.scale.body.empty()) p.scale = &last_.scale;
    p.keep_going = [this](double t) { return report(t); };
    return p;
  }

  // Of a large mechanism it takes long enough to say so.
  void announce_assembly() {
    if (observer_ && model_.bodies.size() > kManyBodies) observer_({0, model_.simulate.duration, 0, clock_.seconds()});
  }

  bool report(double t) {
    const double now = clock_.seconds();
    if (!observer_ || now - reported_ < 0.1) return true;
    reported_ = now;
    return observer_({t, model_.simulate.duration, static_cast<int>(out_.counters.passes) + 1, now});
  }

  // False when it did not reach the end: then the passes before it stand, unless it is the first.
  bool run_pass(double tolerance) {
    auto recorder = std::make_unique<Recorder>(model_, system_, shape_.recorded);
    const IntegrationPlan p = plan(tolerance);
    Integration done = integrate(system_, start_, p, *recorder);
    count(done.counters);
    const bool complete = done.ended == Ended::kAtEnd;
    if (!complete) interrupted_ = {done.ended, done.message};
    if (!complete && fine_) return false;
    coarse_ = std::move(fine_);
    if (coarse_) coarse_->keep_forces_only();
    fine_ = std::move(recorder);
    fine_tolerance_ = tolerance;
    last_ = std::move(done);
    return complete;
  }

  void count(const Counters& done) {
    Counters& c = out_.counters;
    c.steps += done.steps;
    c.rejected += done.rejected;
    c.newton_iterations += done.newton_iterations;
    c.newton_failures += done.newton_failures;
    c.evaluations += done.evaluations;
    c.factorizations += done.factorizations;
    c.events += done.events;
    ++c.passes;
  }

  // theory/time Eqs. (6.1)-(6.3).
  void make_passes() {
    const double wanted = model_.simulate.tolerance;
    PassDifference difference;
    double share = 1, error = 0;
    bool doubted = false;  // a pass has been made because two were alike
    choice_.stages = wanted < kTight ? 5 : 3;
    double tolerance = std::min(wanted, out_.of_motion ? kLoosestOfMotion : choice_.equations == Equations::kIdeal ? kLoosestIdeal : kLoosest);
    if (!shape_.checked) {
      run_pass(tolerance_by_nominal(tolerance));
      return finish(difference, share, error);
    }
    bool complete = run_pass(kPilot * tolerance);
    const Counters& pilot = last_.counters;
    if (complete && choice_.method == "radau" && choice_.stages == 3 && static_cast<double>(pilot.newton_iterations) < kEasy * static_cast<double>(pilot.steps)) {
      choice_.stages = 5;
      fine_.reset();
      complete = run_pass(kPilot * tolerance);
    }
    if (complete) {
      while (true) {
        const double before = fine_tolerance_, steps_before = static_cast<double>(last_.counters.steps);
        if (!run_pass(tolerance)) break;
        difference = difference_of_passes(coarse_->forces(), fine_->forces(), system_.joints.size());
        const bool alike = static_cast<double>(last_.counters.steps) < kAlike * steps_before;
        share = alike || out_.of_motion ? 1.0 : std::min(1.0, kShareOfEqual * std::pow(tolerance / before, kSharePower));
        out_.motion_error = out_.of_motion ? std::max(motion_difference(system_, coarse_->forces(), fine_->forces()), kSurest * fine_tolerance_) : 0;
        error = out_.of_motion ? out_.motion_error : share * largest_of(relative_differences(difference));
        if (alike && !doubted && out_.counters.passes < kMaxPasses && tolerance > kLeastTolerance) {
          doubted = true;
          if (out_.of_motion) choice_.stages = 5;  // long steps are alike at any tolerance: another order tells
          tolerance = std::max(kLeastTolerance, 0.1 * tolerance);
          continue;
        }
        if (error <= kPromised * wanted || out_.counters.passes >= kMaxPasses || tolerance <= kLeastTolerance) break;
        const double shrink = 0.5 * std::pow(wanted / error, 1 / kSharePower);
        tolerance = std::max(kLeastTolerance, tolerance * std::clamp(shrink, 1e-3, 0.1));
      }
    }
    if (shape_.measured != nullptr) *shape_.measured = {wanted, fine_tolerance_, choice_.stages, span_, last_.scale};
    finish(difference, share, error);
  }

  // Of the only pass: that of the second one, or what was enough for the run that the nominal settings are from.
  double tolerance_by_nominal(double second) {
    const NominalRun* nominal = shape_.nominal;
    if (nominal == nullptr || !(nominal->wanted > 0)) return second;
    choice_.stages = nominal->stages;
    last_.scale = nominal->scale;
    return std::clamp(nominal->tolerance * model_.simulate.tolerance / nominal->wanted, kLeastTolerance, second);
  }

  // Each joint's largest difference over its peak force or couple. Joints that carry next to nothing are measured by a
  // small part of the largest of the mechanism; couples at least by that of the largest force at a radius of gyration.
  // The couple of a pin that rubs is a small part of what its force does: its error is stated, and drives no pass.
  std::vector<double> relative_differences(const PassDifference& c) const {
    const double force = largest_of(c.peak);
    const double couple = std::max(largest_of(c.peak_couple), force * system_.largest_radius_of_gyration());
    std::vector<double> out(c.force.size());
    for (std::size_t j = 0; j < out.size(); ++j) {
      const double least = system_.joints[j].servo >= 0 ? kNegligibleOfMotor : kNegligible;
      out[j] = relative(c.force[j], c.peak[j], least * force);
      if (system_.joints[j].law.lever() == 0) out[j] = std::max(out[j], relative(c.couple[j], c.peak_couple[j], least * couple));
    }
    return out;
  }

  // Friction that turns round makes joints ring, within the tolerance of the steps and in all passes alike: their difference does not
  // show it. Over a joint's peak force.
  double least_error() const {
    const bool rubs = std::any_of(system_.joints.begin(), system_.joints.end(), [](const JointData& joint) { return joint.law.rubs(); });
    return rubs && !out_.of_motion ? kPromised * fine_tolerance_ : 0;
  }

  void finish(const PassDifference& difference, double share, double error) {
    fine_->fill(out_);
    out_.t_end = last_.t;
    out_.notes.insert(out_.notes.end(), last_.remarks.begin(), last_.remarks.end());
    const std::vector<double> relative_difference = relative_differences(difference);
    const std::unordered_set<std::string> not_unique(not_unique_.begin(), not_unique_.end());
    const double least = least_error();
    std::size_t row = 0;
    for (std::size_t j = 0; j < system_.joints.size(); ++j) {
      if (system_.joints[j].servo >= 0) continue;
      LoadSummary& joint = out_.joints[row++];
      joint.unique = !not_unique.contains(joint.name);
      if (difference.force.empty()) continue;
      joint.error_estimate = std::max(share * difference.force[j], least * difference.peak[j]);
      joint.moment_error_estimate = share * difference.couple[j];
      joint.relative_error_estimate = std::max(share * relative_difference[j], least);
    }
    const auto worst = std::max_element(relative_difference.begin(), relative_difference.end());
    judge(worst == relative_difference.end() ? nullptr : &system_.joints[static_cast<std::size_t>(worst - relative_difference.begin())], error);
  }

  // How it ended; a pass that broke off leaves the results of the one before it.
  // `worst` has the largest error; none where there is no estimate.
  void judge(const JointData* worst, double error) {
    const bool no_estimate = worst == nullptr;
    const auto& [ended, message] = interrupted_;
    const bool whole = last_.ended == Ended::kAtEnd;
    if (ended == Ended::kStopped) out_.outcome = Outcome::kInterrupted;
    else if (ended == Ended::kFailed && !whole) out_.outcome = Outcome::kFailed;
    else if ((ended == Ended::kFailed && no_estimate) || error > model_.simulate.tolerance) out_.outcome = Outcome::kToleranceNotMet;
    if (no_estimate && shape_.checked && !system_.joints.empty()) out_.notes.push_back("stopped before a second integration: the joint forces have no error estimate");
    if (whole && ended != Ended::kAtEnd)
      out_.notes.push_back(fmt::format("a finer integration did not reach the end{}; the results are those of the previous one", message.empty() ? "" : " (" + message + ")"));
    if (out_.outcome == Outcome::kToleranceNotMet && !no_estimate)
      out_.message = fmt::format("the largest {} is estimated at {:.2g} of {}; the tolerance is {:.2g}",
                                 out_.of_motion ? "position error" : fmt::format("force error, at {} {},", worst->servo < 0 ? "joint" : "motor", worst->name), error,
                                 out_.of_motion ? "the longest path of any body" : "the peak force", model_.simulate.tolerance);
    if (!message.empty() && out_.outcome != Outcome::kCompleted) out_.message += (out_.message.empty() ? "" : "; ") + message;
  }

  const Model& model_;
  const Observer& observer_;
  RunShape shape_;
  Stopwatch clock_;
  System system_;
  State start_;
  Trajectory out_;
  std::vector<std::string> not_unique_;
  MethodChoice choice_;
  std::unique_ptr<Recorder> coarse_, fine_;
  double fine_tolerance_ = 0, span_ = 0;
  Integration last_;
  std::pair<Ended, std::string> interrupted_{Ended::kAtEnd, ""};
  double reported_ = 0;
};

}  // namespace

Trajectory simulate(const Model& model, const Observer& observer) { return Run(model, observer, {}).go(); }

Trajectory simulate_reduced(const Model& model, const RunShape& shape, const Observer& observer) { return Run(model, observer, shape).go(); }

}  // namespace pintle
