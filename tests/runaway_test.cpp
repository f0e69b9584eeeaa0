// Motions that are fed energy without end, machines that only look so, and energy accounts that do not close. theory/time section 8.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A rotor on one pin; `drive` is the effort of the motor on it.
Model rotor(const std::string& drive, const std::string& duration, const std::string& more = "") {
  return parse_model(
      "format = 1\ngravity = [0, \"-9.81 m/s^2\"]\n[simulate]\nduration = \"" + duration +
          "\"\noutput_step = \"" + duration + "/100\"\n[ground.markers]\nO = [0, 0]\n[body.rotor]\nmass = \"2 kg\"\ninertia = \"0.1 kg*m^2\"\nposition = [0, 0]\nmarkers.O = [0, 0]\n"
          "[joint.O]\ntype = \"revolute\"\nbetween = [\"ground.O\", \"rotor.O\"]\n[motor.drive]\njoint = \"O\"\ntorque = \"" + drive + "\"\n" + more,
      "rotor.toml");
}

TEST(Runaway, AControllerOfTheWrongSignIsNamed) {
  const Trajectory run = simulate(reference::test_model("cart_and_pole_wrong_sign"));
  ASSERT_EQ(run.outcome, Outcome::kRunaway) << run.message;
  EXPECT_NE(run.message.find("motor controller feeds it"), std::string::npos) << run.message;
  EXPECT_NE(run.message.find("at t = 0.42"), std::string::npos) << run.message;  // when its energy exceeded what can be stored
  EXPECT_LT(run.t_end, 3);
  EXPECT_GT(run.n_rows(), 10u);
  EXPECT_LT(run.counters.steps, 10000u);
  EXPECT_EQ(run.counters.passes, 2u);
}

TEST(Runaway, NegativeDampingIsNamed) {
  const Trajectory run = simulate(rotor("2*angle_rate + 0.01", "100 s"));
  ASSERT_EQ(run.outcome, Outcome::kRunaway) << run.message;
  EXPECT_NE(run.message.find("motor drive feeds it"), std::string::npos) << run.message;
  EXPECT_LT(run.t_end, 2.0);
}

TEST(Runaway, AForceThatFeedsIsNamed) {
  const Trajectory run = simulate(rotor("0", "100 s", "[force.jet]\non = \"rotor.O\"\ntorque = \"0.1*exp(2*t)\"\n"));
  ASSERT_EQ(run.outcome, Outcome::kRunaway) << run.message;
  EXPECT_NE(run.message.find("force jet feeds it"), std::string::npos) << run.message;
}

// Energies of 5e13, 5e17 and 1e4 J: growing as t^2, as t^2 and more, and within a moment, from nothing.
TEST(Runaway, MachinesThatAreSpunUpAreNot) {
  for (const char* drive : {"1e3", "1e5*t", "100*step(t - 50)", "1e4*smoothstep(40, 60, t)"}) {
    const Trajectory run = simulate(rotor(drive, "100 s"));
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << drive << ": " << run.message;
    EXPECT_EQ(run.t_end, 100) << drive;
  }
  const Trajectory rocket = simulate(rotor("0", "1e4 s", "[force.jet]\non = \"rotor.O\"\ntorque = \"1e6\"\n"));
  EXPECT_EQ(rocket.outcome, Outcome::kCompleted) << rocket.message;
}

TEST(EnergyAccount, APoleInsideTheRunIsNotSteppedOver) {
  const Trajectory run = simulate(rotor("1/(t - 0.1)", "1 s"));
  EXPECT_EQ(run.outcome, Outcome::kEnergyOpen) << run.message;
  EXPECT_NE(run.message.find("has a pole"), std::string::npos) << run.message;
}

// The force of such a servo is a parabola, which one step follows from end to end; its power is of degree five.
TEST(EnergyAccount, ClosesWhereARotorIsBroughtToItsSpeedInOneStep) {
  for (const std::string equations : {"newtonian", "relative"})
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6})
      for (const double inertia : {1e-4, 1e-2})
        for (const double speed : {50.0, 314.0}) {
          Model model = reference::test_model("rotor_on_a_servo", {fmt::format("body.rotor.inertia={}", inertia), fmt::format("parameters.speed={} rad/s", speed), "simulate.equations=" + equations});
          model.simulate.tolerance = tolerance;
          const Trajectory run = simulate(model);
          const double kinetic = 0.5 * inertia * speed * speed;
          EXPECT_EQ(run.outcome, Outcome::kCompleted) << equations << " " << tolerance << " " << inertia << " " << speed << ": " << run.message;
          EXPECT_NEAR(run.energy.supplied, kinetic, 20 * std::max(tolerance, 1e-7) * kinetic) << equations << " " << tolerance << " " << inertia << " " << speed;
        }
}

// The energy stored in a rope that is released goes to the drive that changes its length; a rope cut to a shorter length takes its energy from there.
TEST(EnergyAccount, ClosesWhereALengthJumps) {
  const Trajectory run = simulate(reference::test_model("weight_let_go"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const double weight = 10 * kStandardGravity, stored = weight * weight / (2 * 1e4);
  EXPECT_NEAR(run.energy.supplied, -stored, 1e-4 * stored);
  EXPECT_LT(std::abs(run.energy.drift), 1e-5 * stored);
}

// After 0.5 s the force is not a number.
TEST(NoNumbers, NoMethodStepsIntoThem) {
  for (const char* method : {"radau", "dopri5", "hht"}) {
    Model model = reference::test_model("block_with_a_force_that_ends");
    model.simulate.method = method;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kFailed) << method << ": " << run.message;
    EXPECT_LE(run.t_end, 0.5001) << method;
    for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_TRUE(std::isfinite(reference::value(run, i, "body.block.x"))) << method << " " << i;
  }
}

// The loads of a pass whose account did not close are not used to measure the errors of the next one.
TEST(EnergyAccount, IsClosedByAFinerPass) {
  Model model = reference::test_model("door_with_check_strap");
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LT(std::abs(run.energy.drift), 1e-5) << tolerance;  // of 30 J
  }
}

// The damper of its pin dissipates what the controller feeds: its energy grows no more, but what is left is not a machine.
TEST(TornJoints, AreNotedWithWhatFeedsThem) {
  const auto notes_of = [](const Trajectory& run) {
    std::string all;
    for (const std::string& note : run.notes) all += note + "\n";
    return all;
  };
  const Trajectory run = simulate(reference::test_model("arm_with_wrong_sign"));
  EXPECT_EQ(run.outcome, Outcome::kRunaway) << run.message;
  EXPECT_NE(run.message.find("motor m feeds it"), std::string::npos) << run.message;
  EXPECT_NE(notes_of(run).find("joint J is torn open by 0.025 m, 10 % of the mechanism's size, at t = 0.4094 s"), std::string::npos) << notes_of(run);
  EXPECT_EQ(notes_of(simulate(reference::mechanism("four_bar"))).find("torn"), std::string::npos);
  EXPECT_EQ(notes_of(simulate(reference::mechanism("crane_bushing"))).find("torn"), std::string::npos);  // soft by design
  // A cord that stretches by a twentieth of its length; and a stop, whose force is not the guide's.
  for (const char* made_to_yield : {"dart_caught_by_a_cord", "ram_against_a_hard_stop"}) {
    const Trajectory caught = simulate(reference::test_model(made_to_yield));
    EXPECT_EQ(caught.outcome, Outcome::kCompleted) << caught.message;
    EXPECT_EQ(notes_of(caught).find("torn"), std::string::npos) << notes_of(caught);
  }
}

// It turns faster and faster until its pin gives way; the pin's damper then takes what the motor feeds.
TEST(Runaway, AControllerThatTearsAPinOpenIsNamed) {
  for (const char* duration : {"1 s", "2 s", "10 s"}) {
    const Trajectory run = simulate(reference::test_model("pendulum_wrong_signs", {std::string("simulate.duration=\"") + duration + "\""}));
    ASSERT_EQ(run.outcome, Outcome::kRunaway) << duration << ": " << run.message;
    EXPECT_NE(run.message.find("motor m feeds it"), std::string::npos) << run.message;
    EXPECT_NE(run.message.find("joint O was torn open"), std::string::npos) << run.message;
    EXPECT_LT(run.t_end, 0.6);
    EXPECT_LT(run.counters.steps, 3000u);
  }
}

// Its energy grows exponentially over eight powers of ten, and then no more.
TEST(Runaway, ALimitCycleFromASmallStartIsNot) {
  const Trajectory run = simulate(reference::test_model("van_der_pol_slide"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const int slide = run.column("joint.g.slide");
  double amplitude = 0;
  for (std::size_t i = run.n_rows() / 2; i < run.n_rows(); ++i) amplitude = std::max(amplitude, std::abs(run.at(i, static_cast<std::size_t>(slide))));
  EXPECT_NEAR(amplitude, 10, 0.02);  // twice the displacement at which its damping vanishes
}

}  // namespace
}  // namespace pintle
