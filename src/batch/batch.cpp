#include "batch/batch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "batch/batch_work.h"
#include "dynamics/time_scales.h"
#include "integrators/absolute/radau_stepper.h"
#include "integrators/thresholds.h"
#include "pintle/simulate.h"
#include "run/pass_constants.h"
#include "start/start.h"
#include "system/build.h"

namespace pintle {
namespace {

// Peaks are more accurate than the error estimate of steps: steps of the base are tried with far more than the tolerance, then tightened.
constexpr double kLoosest = 1000;                 // multiple of the tolerance with which steps are tried first
constexpr double kTighten = 3.1622776601683795;  // factor from one try to the next
constexpr double kShare = 0.1;                    // largest deviation of the base's peaks from those of its own run, in tolerances
constexpr double kWorse = 4;                      // upper limit on the errors of a variant's steps, as a multiple of those of the base
constexpr double kOfNewton = 0.2;  // ratio of the tolerance of iterations to that of steps
constexpr int kMostIterations = 10;  // limit in a step of the base: with more, shorter steps are cheaper, and a variant may not converge
constexpr double kMostSlack = 16, kLeastSlack = 1.2;  // factors tried by which the base's joints could be slower before one is soft
constexpr double kUnsettled = 0.01;  // upper limit, as a fraction of the tolerance, on what another sweep would change at the start
constexpr double kWellSettled = 0.2;  // fraction of that limit, for the base
constexpr int kFewestSweeps = 2, kMostSweeps = 4;
constexpr std::size_t kMostSteps = 100'000;  // upper limit for the base: with more, a run of its own costs no more

bool is_for_batches(const Model& model) {
  const SimulateSettings& s = model.simulate;
  return s.start == Start::kAssembled && s.equations == Equations::kNewtonian && s.tolerance_of == ToleranceOf::kForces &&
         (s.method == "auto" || s.method == "radau") && s.duration > 0;
}

// Finds the lengths of the base's steps. Returns false if it does not reach the end.
bool find_steps(const State& start, BatchPlan& plan) {
  RadauStepper stepper(plan.base, plan.tolerance);
  stepper.set_max_step(plan.max_step);
  stepper.set_load_scale(plan.scale);
  stepper.start(start, kFirstStep * plan.duration);
  plan.steps.clear();
  while (stepper.state().t < plan.duration * kAlmostAll) {
    if (plan.steps.size() > kMostSteps || !stepper.step(plan.duration)) return false;
    plan.steps.push_back((stepper.state().t - stepper.previous().t) / plan.duration);
  }
  return true;
}

// Whether a batch finds the peaks of the base's own run, with most of the tolerance to spare. Also sets how large errors of steps may be.
bool is_good(BatchPlan& plan, const Model& base, const Trajectory& run) {
  plan.most_error = HUGE_VAL;
  BatchResult found;
  for (plan.sweeps = kFewestSweeps;; ++plan.sweeps) {
    Batch batch(plan);
    if (!batch.put(0, base)) return false;
    found = batch.run()[0];
    if (found.unsettled <= kWellSettled * kUnsettled * plan.wanted || plan.sweeps == kMostSweeps) break;
  }
  if (!found.good || found.iterations > kMostIterations) return false;
  plan.most_error = kWorse * found.error;
  double force = 0, couple = 0;
  for (const LoadSummary& joint : run.joints) {
    force = std::max(force, joint.peak);
    couple = std::max(couple, joint.peak_moment);
  }
  std::size_t row = 0;
  for (std::size_t j = 0; j < found.joints.size(); ++j) {
    if (plan.base.joints[j].servo >= 0) continue;
    const LoadSummary& joint = run.joints[row++];
    const double share = kShare * plan.wanted;
    if (!(std::abs(found.joints[j].force - joint.peak) <= share * std::max(joint.peak, kNegligible * force))) return false;
    if (joint.has_moment && !(std::abs(found.joints[j].couple - joint.peak_moment) <= share * std::max(joint.peak_moment, kNegligible * couple))) return false;
  }
  return true;
}

// How much slower the joints could be without being soft; 1: not at all.
double slack_of(const System& system, const State& state, double span) {
  for (double slack = kMostSlack; slack > kLeastSlack; slack /= kLeastSlack)
    if (!measure_time_scales(system, state, span / slack).any_soft()) return slack;
  return 1;
}

bool is_near(double x, double y) { return std::abs(x - y) <= 1e-9 * std::abs(y); }

}  // namespace

std::optional<BatchPlan> plan_batch(const Model& base, const NominalRun& nominal, const Trajectory& run) {
  if (!is_for_batches(base) || !(nominal.wanted > 0) || !(nominal.span > 0)) return std::nullopt;
  if (!BatchMechanism::accepts(build_system(base))) return std::nullopt;
  const Assembly start = start_of_run(base, nominal.span);
  if (!(start.settled_over > 0)) return std::nullopt;
  BatchPlan plan;
  plan.base = start.system;
  plan.slack = slack_of(plan.base, start.state, nominal.span);
  plan.duration = base.simulate.duration;
  plan.max_step = base.simulate.max_step;
  plan.wanted = nominal.wanted;
  plan.span = start.settled_over / plan.duration;
  plan.scale = nominal.scale;
  for (double looser = kLoosest; looser > 0.9; looser /= kTighten) {
    plan.tolerance = looser * nominal.tolerance;
    plan.of_newton = std::max(nominal.tolerance, kOfNewton * plan.tolerance);
    if (find_steps(start.state, plan) && is_good(plan, base, run)) return plan;
  }
  return std::nullopt;
}

Batch::Batch(const BatchPlan& plan) : plan_(plan), work_(make_batch_work(plan)) {}
Batch::~Batch() = default;

bool Batch::accepts(const Model& variant) const {
  const SimulateSettings& s = variant.simulate;
  return is_for_batches(variant) && s.tolerance == plan_.wanted && variant.bodies.size() == plan_.base.bodies.size() &&
         is_near(s.max_step / s.duration, plan_.max_step / plan_.duration);
}

// Ensures that no joint of the variant is soft where those of the base are fast.
bool Batch::is_like_base(const System& variant) const {
  if (!BatchMechanism::accepts(variant) || variant.joints.size() != plan_.base.joints.size() || variant.loads.size() != plan_.base.loads.size() ||
      variant.applied.size() != plan_.base.applied.size())
    return false;
  double heavier = 1;
  for (std::size_t i = 0; i < variant.bodies.size(); ++i)
    for (int k = 0; k < 3; ++k) heavier = std::max(heavier, variant.bodies[i].mass[k] / plan_.base.bodies[i].mass[k]);
  for (std::size_t j = 0; j < variant.joints.size(); ++j) {
    const auto &law = *variant.joints[j].law.as_linear(), &base = *plan_.base.joints[j].law.as_linear();
    if (variant.joints[j].at.a != plan_.base.joints[j].at.a || variant.joints[j].at.b != plan_.base.joints[j].at.b) return false;
    for (int k = 0; k < 3; ++k) {
      if ((law.k[k] > 0) != (base.k[k] > 0)) return false;
      if (!(law.k[k] > 0)) continue;
      const double stiffer = law.k[k] / base.k[k], damped = base.c[k] > 0 ? law.c[k] / base.c[k] : law.c[k] > 0 ? HUGE_VAL : 1;
      if (std::min(std::sqrt(stiffer / heavier), stiffer / std::max(1.0, damped)) * plan_.slack < 1) return false;
    }
  }
  return true;
}

bool Batch::put(int lane, const Model& variant) {
  Assembly assembly = assemble_bodies(variant, &plan_.base);
  if (!is_like_base(assembly.system)) return false;
  variant_[lane] = std::move(assembly.system);
  const auto board = [&](int i) {
    work_->put(i, variant_[lane], assembly.state.q, assembly.state.v, variant.simulate.duration);
  };
  if (filled_ == std::array<bool, kVariantLanes>{})
    for (int i = 0; i < kVariantLanes; ++i) board(i);  // lanes that stay empty need numbers, too
  else board(lane);
  filled_[lane] = true;
  return true;
}

std::array<BatchResult, kVariantLanes> Batch::run() {
  std::array<BatchResult, kVariantLanes> out;
  work_->run();
  for (int lane = 0; lane < kVariantLanes; ++lane) {
    if (!filled_[lane]) continue;
    BatchResult& result = out[lane];
    result.error = work_->worst()[lane];
    result.iterations = work_->iterations();
    result.unsettled = work_->unsettled()[lane];
    result.good = std::isfinite(result.error) && result.error <= plan_.most_error && result.unsettled <= kUnsettled * plan_.wanted;
    for (const BatchPeak& peak : work_->peaks()) {
      result.joints.push_back({std::sqrt(peak.square[lane]), peak.time[lane], std::sqrt(peak.couple_square[lane])});
      result.good = result.good && std::isfinite(peak.square[lane] + peak.couple_square[lane]);
    }
  }
  filled_.fill(false);
  return out;
}

std::unique_ptr<Batch> BatchPool::borrow() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) return std::make_unique<Batch>(plan_);
  std::unique_ptr<Batch> batch = std::move(idle_.back());
  idle_.pop_back();
  return batch;
}

void BatchPool::give_back(std::unique_ptr<Batch> batch) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(batch));
}

}  // namespace pintle
