// The trapezoidal rule, HHT-alpha and generalised-alpha: their order, their error constants, their effect on vibrations much
// faster than the step, and their energy account.
#include "integrators/general/alpha_stepper.h"

#include <gtest/gtest.h>

#include <utility>

#include "integrators/absolute/radau_stepper.h"
#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

constexpr double kNoControl = 1e9;  // a tolerance that accepts every step

const std::vector<std::pair<const char*, AlphaWeights>>& family() {
  static const std::vector<std::pair<const char*, AlphaWeights>> list{{"trapezoidal", AlphaWeights::trapezoidal()},
                                                                      {"hht", AlphaWeights::hht(-0.05)},
                                                                      {"generalised", AlphaWeights::generalised(0.9)}};
  return list;
}

State run_alpha(const System& system, const State& from, const AlphaWeights& weights, double duration, int n) {
  AlphaStepper stepper(system, weights, kNoControl);
  stepper.set_max_step(duration / n);
  stepper.start(from, duration / n);
  for (int i = 0; i < n; ++i) EXPECT_TRUE(stepper.step(duration)) << stepper.failure();
  EXPECT_NEAR(stepper.state().t, duration, 1e-12 * duration);
  return stepper.state();
}

// Errors in positions, velocities and joint forces fall as h^2 when steps are halved.
void expect_second_order(const Model& model, const State& from, double duration, int n) {
  const System system = build_system(model);
  RadauStepper truth(system, 1e-10, 5);
  truth.start(from, 1e-5);
  while (truth.state().t < duration) ASSERT_TRUE(truth.step(duration)) << truth.failure();
  for (const auto& [name, weights] : family()) {
    std::vector<double> q, v, f;
    for (int k = 0; k < 4; ++k, n *= 2) {
      const State end = run_alpha(system, from, weights, duration, n);
      q.push_back(sample::largest_difference(end.q, truth.state().q));
      v.push_back(sample::largest_difference(end.v, truth.state().v));
      f.push_back(sample::largest_difference(end.force, truth.state().force));
    }
    n /= 16;
    for (const auto* errors : {&q, &v, &f}) {
      EXPECT_GT(sample::measured_order(*errors), 1.9) << name;
      EXPECT_LT(sample::measured_order(*errors), 2.1) << name;
    }
  }
}

TEST(AlphaStepper, IsOfOrderTwoOnAPendulum) {
  const Model model = sample::pendulum(1e3, 20);
  expect_second_order(model, sample::plain_start(model, build_system(model)), 0.3, 200);
}

TEST(AlphaStepper, IsOfOrderTwoOnASoftFourBar) {
  const Model model = sample::four_bar(2e3, 20);
  expect_second_order(model, sample::plain_start(model, build_system(model)), 0.3, 200);
}

// A body of mass 1 pushed by a force that only depends on time.
Model pushed_by(const char* force) {
  Model model;
  model.gravity = {0, 0};
  model.bodies = {sample::body("mass", 1, 1, {{"C", {0, 0}, 0}})};
  sample::put_at(model.bodies[0], 0, 0, 0);
  AppliedForce push;
  push.name = "F";
  push.on = {"mass", "C"};
  push.force = {sample::expression(force), Expression::constant(0)};
  model.forces = {push};
  return model;
}

// theory/solvers Eqs. (3.5), (3.6): with F = t^2 the third derivative of v is 2, and each step errs by the same amount;
// with F = t that of q is 1, and v is exact.
TEST(AlphaStepper, StepsErrByTheirErrorConstants) {
  for (const auto& [name, weights] : family()) {
    const Model square = pushed_by("t^2"), line = pushed_by("t");
    const System of_square = build_system(square), of_line = build_system(line);
    const double h = 0.1;
    const auto error = [&weights = weights, h](const System& system, const Model& model, int steps, bool velocity) {
      const State end = run_alpha(system, sample::plain_start(model, system), weights, steps * h, steps);
      const double t = steps * h;
      return velocity ? end.v[0][0] - t * t * t / 3 : end.q[0][0] - t * t * t / 6;
    };
    const int n = 100;  // the effect of a start without a lag has died out by then
    const double in_v = error(of_square, square, n + 1, true) - error(of_square, square, n, true);
    EXPECT_NEAR(in_v, 2 * weights.velocity_error() * h * h * h, 1e-11) << name;
    // The error that the first steps left in v persists.
    const State end = run_alpha(of_line, sample::plain_start(line, of_line), weights, n * h, n);
    const double v_error = end.v[0][0] - n * n * h * h / 2;
    const double in_q = error(of_line, line, n + 1, false) - error(of_line, line, n, false) - h * v_error;
    EXPECT_NEAR(in_q, weights.position_error() * h * h * h, 1e-11) << name;
  }
}

// The undamped spring of k = m w^2 in a joint: exactly linear.
struct Spring {
  const Model model = mass_on_spring();
  const System system = build_system(model);
  const State from = sample::plain_start(model, system);

  static Model mass_on_spring() {
    Model model;
    model.gravity = {0, 0};
    model.ground = {{"O", {0, 0}, 0}};
    model.bodies = {sample::body("mass", 1, 1, {{"C", {0, 0}, 0}})};
    sample::put_at(model.bodies[0], 1, 0, 0);
    model.joints = {sample::joint("pin", "revolute", {"ground", "O"}, {"mass", "C"}, 1, 0)};
    return model;
  }
  static double energy(const State& s) { return 0.5 * (s.v[0].squaredNorm() + s.q[0].squaredNorm()); }
};

// With any step, the trapezoidal rule conserves the energy of a linear oscillator to roundoff.
TEST(AlphaStepper, TrapezoidalRuleDoesNotDamp) {
  const Spring spring;
  for (const double h : {0.05, 1.0, 40.0}) {
    const State end = run_alpha(spring.system, spring.from, AlphaWeights::trapezoidal(), 400 * h, 400);
    EXPECT_NEAR(Spring::energy(end) / Spring::energy(spring.from), 1, 1e-10) << h;
  }
}

// The factor that a vibration much faster than the step retains per step. The limit is at most a triple root,
// so the decay over n steps has an additional factor n^2, which is less than one part in a hundred here.
TEST(AlphaStepper, DampsFastVibrationsAsDesigned) {
  const Spring spring;
  const double h = 1e4;
  const auto size = [h](const State& s) { return s.q[0].norm() + h * s.v[0].norm() + h * h * s.a[0].norm(); };
  const auto kept = [&](const AlphaWeights& weights) {
    const int n = 250, more = 150;
    AlphaStepper stepper(spring.system, weights, kNoControl);
    stepper.set_max_step(h);
    stepper.start(spring.from, h);
    double middle = 0;
    for (int i = 0; i < n + more; ++i) {
      EXPECT_TRUE(stepper.step(1e12));
      if (i + 1 == n) middle = size(stepper.state());
    }
    return std::pow(size(stepper.state()) / middle, 1.0 / more);
  };
  EXPECT_NEAR(kept(AlphaWeights::generalised(0.9)), 0.9, 1e-2);
  EXPECT_NEAR(kept(AlphaWeights::generalised(0.6)), 0.6, 1e-2);
  EXPECT_NEAR(kept(AlphaWeights::hht(-0.05)), 0.95 / 1.05, 1e-2);
  EXPECT_NEAR(kept(AlphaWeights::hht(-0.3)), 0.7 / 1.3, 1e-2);
}

TEST(AlphaStepper, ClosesItsEnergyAccountToItsOrder) {
  Model model = sample::oscillator();
  model.springs[0].damping = 1.5;
  const System system = build_system(model);
  const State from = sample::plain_start(model, system);
  const auto total = [&system](const State& s) {
    std::vector<Planar::Motion> m;
    system.motions(s.q, s.v, m);
    return system.kinetic(s.v) + system.external_work(s.t, s.q, m).potential + s.dissipated - s.supplied;
  };
  for (const auto& [name, weights] : family()) {
    std::vector<double> drift;
    for (const int n : {200, 400, 800}) drift.push_back(std::abs(total(run_alpha(system, from, weights, 2, n)) - total(from)));
    EXPECT_GT(sample::measured_order(drift), 1.9) << name;
  }
}

// Inside a step forces lie between those of its ends, and positions are on a cubic.
TEST(AlphaStepper, InterpolatesInsideAStep) {
  const Model model = sample::pendulum(1e3, 20);
  const System system = build_system(model);
  AlphaStepper stepper(system, AlphaWeights::trapezoidal(), kNoControl);
  stepper.set_max_step(0.01);
  stepper.start(sample::plain_start(model, system), 0.01);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(stepper.step(1));
  const State a = stepper.previous(), b = stepper.state();
  EXPECT_EQ(stepper.interpolate(a.t).q[0], a.q[0]);
  EXPECT_EQ(stepper.interpolate(b.t).q[0], b.q[0]);
  const State m = stepper.interpolate(0.5 * (a.t + b.t));
  EXPECT_LT((m.force[0] - 0.5 * (a.force[0] + b.force[0])).norm(), 1e-9);
  EXPECT_LT((m.q[0] - (0.5 * (a.q[0] + b.q[0]) + (b.t - a.t) / 8 * (a.v[0] - b.v[0]))).norm(), 1e-12);
}

}  // namespace
}  // namespace pintle
