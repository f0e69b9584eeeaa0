// The pendulum of the paper's section 7 against its exact solution, with an ideal pin and with a compliant one.
#include <gtest/gtest.h>

#include "integrators/absolute/radau_stepper.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

// The ideal pin's force at an angle from the vertical, released from rest at 90 deg; x downwards.
struct IdealPin {
  double fx, fy;
  explicit IdealPin(double theta) {
    const double g = 9.81, r = 0.5, J = 1.0 / 3, alpha = -g * r / J * std::sin(theta), omega2 = 2 * g * r / J * std::cos(theta);
    fx = r * (-alpha * std::sin(theta) - omega2 * std::cos(theta)) - g;
    fy = r * (alpha * std::cos(theta) - omega2 * std::sin(theta));
  }
};

double pin_error(const Trajectory& run, std::size_t row) {
  const IdealPin ideal(value(run, row, "body.rod.angle"));
  return std::max(std::abs(value(run, row, "joint.pin.on_rod.fx[world]") - ideal.fx), std::abs(value(run, row, "joint.pin.on_rod.fy[world]") - ideal.fy));
}

TEST(ReferencePendulum, AngleAndForceAreThoseOfAnIdealPinThroughout) {
  Model model = reference::mechanism("pendulum");
  model.simulate.tolerance = 1e-6;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  for (std::size_t row = 0; row < run.n_rows(); ++row) EXPECT_LT(pin_error(run, row), 5e-5) << run.at(row, 0);
  const reference::Table exact = reference::read_table("pendulum");
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.rod.angle"), exact.at(i, "theta"), 2e-6);
    EXPECT_NEAR(value(run, row, "body.rod.spin"), exact.at(i, "omega"), 2e-5);
    EXPECT_NEAR(value(run, row, "joint.pin.on_rod.fx[world]"), exact.at(i, "Fx"), 5e-5);
    EXPECT_NEAR(value(run, row, "joint.pin.on_rod.fy[world]"), exact.at(i, "Fy"), 5e-5);
  }
}

// Without initial stretch the pin carries nothing at first, 2.4525 N too little, and reaches its load within 10 ms.
TEST(ReferencePendulum, ARawStartIsOffForSomeMillisecondsOnly) {
  Model model = reference::mechanism("pendulum");
  model.simulate.tolerance = 1e-6;
  model.simulate.start = Start::kRaw;
  model.simulate.output_step = 1e-3;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_NEAR(pin_error(run, 0), 2.4525, 1e-6);
  for (std::size_t row = 0; row < run.n_rows(); ++row) EXPECT_LT(pin_error(run, row), run.at(row, 0) < 0.01 ? 2.4526 : 5e-5) << run.at(row, 0);
}

TEST(ReferencePendulum, ARawStartIsFollowedInAllDigits) {
  Model model = reference::mechanism("pendulum");
  model.simulate.tolerance = 1e-7;
  model.simulate.start = Start::kRaw;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const reference::Table exact = reference::read_table("pendulum_compliant");
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.rod.x"), exact.at(i, "x"), 1e-7);
    EXPECT_NEAR(value(run, row, "body.rod.y"), exact.at(i, "y"), 1e-7);
    EXPECT_NEAR(value(run, row, "body.rod.angle"), exact.at(i, "theta"), 1e-7);
    EXPECT_NEAR(value(run, row, "body.rod.spin"), exact.at(i, "omega"), 1e-6);
    EXPECT_NEAR(value(run, row, "joint.pin.on_rod.fx[world]"), exact.at(i, "Fx"), 1e-5);
    EXPECT_NEAR(value(run, row, "joint.pin.on_rod.fy[world]"), exact.at(i, "Fy"), 1e-5);
  }
}

// The dashpot's part of the pin force stays below 1e-4 of the spring's peak.
TEST(ReferencePendulum, TheDashpotCarriesNextToNothing) {
  const Model model = reference::mechanism("pendulum");
  const Assembly start = start_of_run(model);
  RadauStepper stepper(start.system, 1e-6);
  stepper.start(start.state, 1e-3);
  double spring = 0, dashpot = 0;
  while (stepper.state().t < 2) {
    ASSERT_TRUE(stepper.step(2)) << stepper.failure();
    spring = std::max(spring, 2e8 * stepper.state().gap[0].head<2>().norm());
    dashpot = std::max(dashpot, 3500 * stepper.state().gap_rate[0].head<2>().norm());
  }
  EXPECT_NEAR(spring, 24.525, 0.3);
  EXPECT_LT(dashpot / spring, 1e-4);
  EXPECT_GT(dashpot / spring, 1e-6);
}

// Without damping the stretch that is missing at the start rings for ever, at 28 284 rad/s and less. Both methods follow it; the explicit one to 1e-8, since
// the roundoff of a position is a force of 2e-8 N.
TEST(ReferencePendulum, UndampedRippleIsTheTrueOne) {
  Model model = reference::mechanism("pendulum");
  model.simulate.start = Start::kRaw;
  model.simulate.duration = 4e-3;
  model.simulate.output_step = 1e-5;
  reference::set_joints(model, 2e8, 0);
  const Trajectory run = simulate(model);
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  Trajectory direct;
  ASSERT_EQ(reference::integrate_once(model, 1e-8, 0, nullptr, &direct).ended, Ended::kAtEnd);
  ASSERT_EQ(run.n_rows(), direct.n_rows());
  double largest = 0, peak = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double fx = value(direct, row, "joint.pin.on_rod.fx[world]"), fy = value(direct, row, "joint.pin.on_rod.fy[world]");
    largest = std::max(largest, reference::force_error(run, row, "pin.on_rod", fx, fy));
    peak = std::max(peak, std::hypot(fx, fy));
  }
  EXPECT_NEAR(peak, 2 * 2.4525, 0.01);  // the load, and as much again for the part of it that is missing at the start
  EXPECT_LE(largest, model.simulate.tolerance * peak);
}

}  // namespace
}  // namespace pintle
