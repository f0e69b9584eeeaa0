// Surfaces that stick on a spring and break loose because the force that presses them falls: the spring may be on its way back. theory/joints Eq. (3.23)
#include <gtest/gtest.h>

#include <cmath>

#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// Friction that drives would let the account run open, and what moves.
void expect_closed_account(const Trajectory& run) { EXPECT_LT(run.energy.drift, 1e-6 * run.energy.kinetic_peak); }

// It swings on the stiction spring that holds it, with 5 N*s/m.
TEST(FrictionRebound, ASlideThatIsUnloadedOnItsWayBackIsHeldAgain) {
  const Trajectory run = reference::completed(reference::test_model("slide_unloaded_while_stuck"));
  expect_closed_account(run);
  EXPECT_LT(std::abs(reference::value(run, run.n_rows() - 1, "joint.g.slide_rate")), 0.02);
  EXPECT_EQ(reference::value(run, run.n_rows() - 1, "joint.g.stuck"), 1);
}

TEST(FrictionRebound, ACartThatSettlesOnItsTyresIsNotDriven) {
  const Trajectory run = reference::completed(reference::test_model("cart_put_on_the_road"));
  expect_closed_account(run);
  for (std::size_t row = 0; row < run.n_rows(); ++row) ASSERT_LT(std::abs(reference::value(run, row, "joint.rr.slip")), 0.3) << run.at(row, 0);
}

// Its friction is that of the teeth that touch: with stuck springs at teeth that did not touch, the motor gave 1700 N m.
TEST(FrictionRebound, TeethThatDoNotTouchDoNotStick) {
  const Trajectory run = reference::completed(reference::test_model("rack_with_play_that_rubs"));
  for (std::size_t row = 0; row < run.n_rows(); ++row)
    ASSERT_LE(std::abs(reference::value(run, row, "joint.rack.friction")), 0.15 * 2.4e-3 * reference::value(run, row, "joint.rack.normal_force") + 1e-9) << run.at(row, 0);
  EXPECT_NEAR(std::abs(run.motors[0].peak_effort), 4.12, 0.05);
}

// A trial step that goes astray passes the bends of its detent a million times: that is no guide to where the first one is.
TEST(FrictionRebound, ABladeComesToRestBesideItsDetent) {
  const Trajectory run = reference::completed(reference::test_model("garden_shears"));
  EXPECT_EQ(reference::value(run, run.n_rows() - 1, "joint.O.stuck"), 1);
  EXPECT_NEAR(reference::value(run, run.n_rows() - 1, "joint.O.angle"), -std::acos(-1) / 6, 2e-3);
}

// At a speed that is only roundoff, the sign of the rate differs between iterations: no step is short enough for Newton's method.
TEST(FrictionRebound, ATorqueThatJumpsWithTheRateComesToRest) {
  for (const char* friction : {"coulomb", "lugre"})
    for (const double tolerance : {1e-3, 1e-5}) {
      Model model = reference::test_model("pin_with_a_torque_against_its_rate", {std::string("joint.o.friction=\"") + friction + "\""});
      model.simulate.tolerance = tolerance;
      const Trajectory run = reference::completed(model);
      EXPECT_NEAR(run.joints[0].peak, 19.86, 0.02) << friction << ", " << tolerance;
    }
}

// The projection of a step's end divides by mass and friction slope together. Where these cancelled, one step had a force of 1.3 MN, and four of five were rejected.
TEST(FrictionRebound, FrictionThatFallsWithSpeedIsNotDividedBy) {
  const auto lift = [](double tolerance) {
    Model model = reference::test_model("scissor_lift_with_falling_friction");
    model.simulate.tolerance = tolerance;
    return reference::completed(model);
  };
  const Trajectory run = lift(1e-5), finer = lift(1e-7);
  for (std::size_t j = 0; j < run.joints.size(); ++j) EXPECT_NEAR(run.joints[j].peak, finer.joints[j].peak, 1e-5 * finer.joints[j].peak) << run.joints[j].name;
  EXPECT_LT(finer.counters.rejected, finer.counters.steps / 2);
}

}  // namespace
}  // namespace pintle
