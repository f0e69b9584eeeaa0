// The explicit pair: its order on a closed form, and the paper's pendulum with finite stiffness.
#include "integrators/general/dopri5.h"

#include <gtest/gtest.h>

#include "integrators/start_states_for_tests.h"

namespace pintle {
namespace {

// Error control off: a step of `h` each time.
State run_fixed(const Model& model, const System& system, double duration, int steps) {
  Dopri5 stepper(system, 1e30);
  stepper.set_max_step(duration / steps);
  stepper.start(sample::plain_start(model, system), duration / steps);
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(stepper.step(duration));
  EXPECT_NEAR(stepper.state().t, duration, 1e-12 * duration);
  return stepper.state();
}

TEST(Dopri5, IsOfOrderFive) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  std::vector<double> errors;
  for (const int n : {40, 80, 160}) {
    const State end = run_fixed(model, system, 2, n);
    const auto [x, v] = sample::oscillator_at(2);
    errors.push_back(std::hypot(end.q[0][0] - x, (end.v[0][0] - v) / 5));
  }
  EXPECT_GT(sample::measured_order(errors), 4.7);
  EXPECT_LT(errors.back(), 1e-7);
}

TEST(Dopri5, KeepsToItsTolerance) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  double last = 1e9;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    Dopri5 stepper(system, tolerance);
    stepper.start(sample::plain_start(model, system), 1e-3);
    while (stepper.state().t < 2) ASSERT_TRUE(stepper.step(2));
    EXPECT_EQ(stepper.state().t, 2);
    const double error = std::abs(stepper.state().q[0][0] - sample::oscillator_at(2)[0]);
    EXPECT_LT(error, 10 * tolerance);
    EXPECT_LT(error, last);
    last = error;
  }
}

// Two explicit runs of the same equations, tolerances 1e-12 and 1e-10, agreed to 1e-13 in the coordinates and 2e-7 N;
// k = 1e6 N/m, c = 500 N s/m, g = 9.81, zero stretch at the start (paper, section 7, in this program's axes).
TEST(Dopri5, PendulumOnASoftPinIsTheKnownOne) {
  const Model model = sample::pendulum(1e6, 500);
  const System system = build_system(model);
  Dopri5 stepper(system, 1e-9);
  stepper.start(sample::plain_start(model, system), 1e-5);
  while (stepper.state().t < 0.5) ASSERT_TRUE(stepper.step(0.5));
  const State& end = stepper.state();
  EXPECT_NEAR(end.q[0][0], -0.04508905804234097, 1e-9);
  EXPECT_NEAR(end.q[0][1], -0.49798735698856916, 1e-9);
  EXPECT_NEAR(end.q[0][2], -0.0902969256526083 - std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(end.v[0][2], -5.413666303942199, 1e-8);
  EXPECT_NEAR(end.force[0][0], 1.982308636858221, 1e-5);
  EXPECT_NEAR(end.force[0][1], 24.345643436112493, 1e-5);
}

TEST(Dopri5, StopsExactlyAtTheEnd) {
  const Model model = sample::oscillator();
  const System system = build_system(model);
  Dopri5 stepper(system, 1e-3);
  stepper.start(sample::plain_start(model, system), 10);
  for (const double end : {0.01, 0.0100001, 0.5}) {
    while (stepper.state().t < end) ASSERT_TRUE(stepper.step(end));
    EXPECT_EQ(stepper.state().t, end);
  }
}

// Unstretched joints and no gravity: no force at the start to compare an error with.
TEST(Dopri5, StartsWithoutAnyLoad) {
  const Model model = sample::four_bar(1e8, 3000);
  const System system = build_system(model);
  Dopri5 stepper(system, 1e-3);
  stepper.start(sample::plain_start(model, system), 1e-6);
  EXPECT_TRUE(stepper.step(1e-3)) << stepper.failure();
}

// Kinetic + potential + dissipated - supplied stays constant, to the accuracy of the account's trapezoidal rule.
TEST(Dopri5, ClosesItsEnergyAccount) {
  Model model = sample::oscillator();
  model.springs[0].damping = 1.5;
  const System system = build_system(model);
  Dopri5 stepper(system, 1e-8);
  const auto total = [&system](const State& s) {
    std::vector<Planar::Motion> m;
    system.motions(s.q, s.v, m);
    return system.kinetic(s.v) + system.external_work(s.t, s.q, m).potential + s.dissipated - s.supplied;
  };
  stepper.start(sample::plain_start(model, system), 1e-3);
  const double before = total(stepper.state());
  while (stepper.state().t < 2) ASSERT_TRUE(stepper.step(2));
  EXPECT_NEAR(total(stepper.state()), before, 2e-3);
  EXPECT_GT(stepper.state().dissipated, 1);
}

}  // namespace
}  // namespace pintle
