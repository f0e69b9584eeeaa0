// Coulomb friction at the onset of sticking: it continues with the force of slip.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;

// A mass of 2 kg, pulled along the floor by a spring of stiffness k whose far end moves at `speed`; gravity is 10 m/s^2.
Model pulled_slider(double k, double speed, double kinetic, double stuck, double duration) {
  Model model = parse_model(reference::pulled_mass(10, fmt::format("friction = \"coulomb\"\nfriction_coefficient = {}\nstatic_friction = {}\n", kinetic, stuck), 2, k, speed), "pulled_slider.toml");
  model.simulate.duration = duration;
  model.simulate.output_step = 0.01;
  return model;
}

// Round numbers, for which the speed vanishes just as a row or a step ends.
TEST(StickSlip, SticksWithTheFrictionThatItSlippedWith) {
  struct Case {
    double k, speed, kinetic, stuck;
  };
  for (const Case& at : {Case{100, 0.05, 0.3, 0.5}, Case{200, 0.03, 0.2, 0.4}, Case{50, 0.08, 0.1, 0.2}})
    for (const double tolerance : {1e-3, 1e-5}) {
      for (const double row : {0.01, 0.0005}) {
        Model model = pulled_slider(at.k, at.speed, at.kinetic, at.stuck, 6);
        model.simulate.tolerance = tolerance;
        model.simulate.output_step = row;
        const Trajectory run = completed(model);
        ASSERT_EQ(run.events.size(), 1U);
        int sticks = 0;
        double before = -1;
        for (const JointEvent& event : run.events.front().events) {
          if (event.what != "sticks") continue;
          ++sticks;
          EXPECT_NEAR(event.values[0], -20 * at.kinetic, 20 * 1e-4) << event.t << ", k = " << at.k << ", tolerance " << tolerance << ", row " << row;
          EXPECT_GT(event.t, before);
          before = event.t;
        }
        EXPECT_GT(sticks, 0);
      }
    }
}

// A slider pulled ever harder breaks loose when its stiction spring carries the static friction: V t = F/k + F/k_t - c_t/k_t V k/k_t; while stuck, it moves with V k/k_t.
TEST(StickSlip, BreaksLooseOnTime) {
  Model model = pulled_slider(100, 0.05, 0.3, 0.4, 2);
  model.simulate.tolerance = 1e-7;
  const Trajectory run = completed(model);
  const double F = 0.4 * 20, k = 100, speed = 0.05, k_t = 1e8, c_t = 1e5;
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].events[0].what, "slips");
  EXPECT_NEAR(run.events[0].events[0].t * speed, F / k + F / k_t - c_t / k_t * speed * k / k_t, 1e-12);
}

// The heat of a joint while it sticks is what its spring had stored, F^2/(2 k_t); while it slips, friction times distance.
TEST(StickSlip, HeatIsThatOfEachStretch) {
  const Trajectory run = completed(pulled_slider(100, 0.05, 0.3, 0.5, 6));
  const std::vector<JointEvent>& events = run.events.at(0).events;
  ASSERT_GE(events.size(), 4U);
  double all = 0, slid = 0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double heat = events[i].values.back();
    all += heat;
    if (events[i].what == "slips") EXPECT_NEAR(heat, 10.0 * 10.0 / 2e8, 1e-7) << i;
    else EXPECT_GT(heat, 0.1) << i;
    if (events[i].what == "sticks") slid += heat;
  }
  EXPECT_NEAR(slid, 20 * 0.3 * std::abs(reference::value(run, run.n_rows() - 1, "joint.slide.slide")), 1e-5 * slid);
  EXPECT_NEAR(all, run.joints.at(0).heat, 1e-3 * all);
}

// theory/joints Eq. (3.20): the spring starts with the kinetic friction, against the load.
TEST(StickSlip, ABlockThatStopsOnASlopeStays) {
  for (const double degrees : {15.0, 18.0, 20.0, 24.0}) {
    const Trajectory run = completed(reference::test_model("block_thrown_up_a_slope", {fmt::format("parameters.a=\"{} deg\"", degrees)}));
    const double a = degrees * kPi / 180, rest = 1 / (2 * 9.80665 * (std::sin(a) + 0.3 * std::cos(a)));
    EXPECT_NEAR(reference::at_end(run, "joint.slide.slide"), rest, 1e-6) << degrees;
    EXPECT_EQ(reference::at_end(run, "joint.slide.stuck"), 1) << degrees;
  }
}

// Deflections reverse neither a shaft that begins to turn nor its friction. Torques, with the force F of the mesh, the tension T and the friction t.
TEST(StickSlip, FrictionResistsTheMotorThatStarts) {
  for (const auto& [mu, r] : {std::pair{0.2, 0.020}, std::pair{0.3, 0.100}}) {
    const Trajectory run = completed(reference::test_model("hoist_against_friction", {fmt::format("parameters.mu={}", mu), fmt::format("parameters.r={}", r)}));
    const double g = 9.80665, r1 = 0.04, r2 = 0.2, phi = 20 * kPi / 180;
    double friction = 0, T = 0, F = 0;
    for (int i = 0; i < 50; ++i) {  // the acceleration a of the load, from the energy of all bodies
      const double a = ((600 - friction) / r1 - 500 * g) / (500 + 2 / (r2 * r2) + 0.05 / (r1 * r1));
      T = 500 * (g + a);
      F = (T + 2 * a / (r2 * r2)) / std::cos(phi);
      friction = mu * r * std::hypot(F * std::sin(phi), F * std::cos(phi) - 20 * g);
    }
    EXPECT_NEAR(reference::value(run, 0, "joint.motor_shaft.friction"), friction, 1e-3 * friction) << mu;
    EXPECT_NEAR(reference::value(run, 0, "joint.rope.tension"), T, 1e-3 * T) << mu;
    EXPECT_NEAR(run.joints.at(2).peak, F, 0.02 * F) << mu;
  }
}

// A block of 2 kg, pushed to and fro on a dry guide, sticks and slips; the guide never holds it with more than static friction, whatever the method.
TEST(StickSlip, NoMethodTellsMoreThanStaticFriction) {
  constexpr double kWeight = 2 * kStandardGravity, kStuck = 0.4;
  for (const char* method : {"radau", "dopri5", "ode45", "ode15s", "ode113", "hht"}) {
    Model model = reference::test_model("block_pushed_to_and_fro");
    model.simulate.method = method;
    const Trajectory run = simulate(model);
    EXPECT_NEAR(run.joints.front().peak, std::hypot(kWeight, kStuck * kWeight), 1e-3 * kWeight) << method;
  }
}

// A sled that comes to rest without reversing slips on, at almost no speed. The compensation of an event crossed late may take it past zero: friction then drove it on.
TEST(StickSlip, FrictionTurnsWithASledThatALoadTurns) {
  // 60 x" = 800 - 1000 (x + 0.2 - 1 + 1) - 100 x' - 100 sign(x'), from where 100 N of friction have left it
  constexpr double kMass = 60, kStiffness = 1000, kDamping = 100, kFriction = 100, kPull = 800, kJump = 0.5, kAt = 1.44;
  const double decay = kDamping / (2 * kMass), omega = std::sqrt(kStiffness / kMass - decay * decay);
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    Model model = reference::test_model("sled_turned_by_a_force");
    model.simulate.tolerance = tolerance;
    model.simulate.output_step = 0.005;
    const Trajectory run = completed(model);
    const auto row_at = [&run](double t) {
      std::size_t row = 0;
      while (run.at(row, 0) < t - 1e-9) ++row;
      return row;
    };
    // Before it turns back: a decaying swing about the position where the spring carries the pull less friction.
    const double before = reference::value(run, row_at(kJump) - 1, "body.sled.x"), unloaded = 0.8 - 1, middle = unloaded + (kPull - kFriction) / kStiffness, swing = before - middle;
    const double turns = kJump + std::numbers::pi / omega;
    ASSERT_GT(turns, 1.2);
    const double since = 1.2 - kJump, exact = middle + std::exp(-decay * since) * swing * (std::cos(omega * since) + decay / omega * std::sin(omega * since));
    EXPECT_NEAR(reference::value(run, row_at(1.2), "body.sled.x"), exact, 1e-4) << tolerance;
    EXPECT_NEAR(reference::value(run, row_at(kAt), "body.sled.x"), 0.7920, 2e-4) << tolerance;
    for (std::size_t row = 1; row < run.n_rows(); ++row)
      EXPECT_GE(reference::value(run, row, "energy.dissipated"), reference::value(run, row - 1, "energy.dissipated") - 1e-4) << run.at(row, 0) << " " << tolerance;
  }
}

// The lock that finds the load of a sticking joint used to deflect by 2 rad, and the friction had the sign that the spring would have there.
TEST(StickSlip, WhatSticksSoftlyDoesNotStartAgainstItsFriction) {
  constexpr double kWeight = 2 * kStandardGravity, kArm = 0.6, kInertia = 0.8 + 2 * kArm * kArm, kSpring = 500, kRadius = 0.05, kKinetic = 0.2;
  double force = 0;
  for (int i = 0; i < 50; ++i) force = std::abs(kWeight + 2 * kArm * (kSpring - kWeight * kArm - kKinetic * kRadius * force) / kInertia);
  for (const char* stiffness : {"2e4", "1e5", "1e8"}) {
    const Trajectory run = completed(reference::test_model("lever_thrown_by_a_spring", {std::string("joint.pivot.stick_stiffness=") + stiffness}));
    EXPECT_NEAR(run.joints.at(0).peak, force, 1e-4 * force) << stiffness;
    EXPECT_GT(run.energy.dissipated, 0) << stiffness;
  }
}

// It slips when the pull reaches the static friction, at any scale.
TEST(StickSlip, HasNoScaleOfItsOwn) {
  const Trajectory run = completed(reference::test_model("cube_of_ten_micrometres"));
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events.at(0).events.at(0).t, 0.3 * 2.33e-12 * kStandardGravity / 1e-11, 1e-6);
}

// A runner on a track carries its largest load just before it breaks away, 5 us after a force has jumped: no step saw the last 4e-5 of that.
TEST(StickSlip, WhatBreaksAwayWasLoadedWithAllThatHeldIt) {
  const double most = 3 * kStandardGravity * std::hypot(1, 0.3);
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative})
    for (const double tolerance : {1e-5, 1e-6, 1e-7}) {
      Model model = reference::test_model("runners_on_a_track");
      model.simulate.tolerance = tolerance;
      model.simulate.equations = equations;
      const Trajectory run = completed(model);
      EXPECT_NEAR(run.joints.at(0).peak, most, tolerance * most) << tolerance;
    }
}

// Either friction alone could hold the door. Firm locks on both carried its whole weight, for which neither suffices: the axle started slipping, the door was
// thrown upwards, and the rope carried 877 N, or 1102 N with the larger pin.
TEST(StickSlip, WhatEitherOfTwoFrictionsCouldHoldStartsAtRest) {
  for (const char* radius : {"12 mm", "30 mm"}) {
    const Trajectory run = completed(reference::test_model("garage_door_at_rest", {std::string("joint.axle.pin_radius=\"") + radius + "\""}));
    for (std::size_t row = 0; row < run.n_rows(); row += 100) {
      const double rope = std::abs(reference::value(run, row, "joint.rope.on_drum.fy[world]")), rail = reference::value(run, row, "joint.rail.friction");
      EXPECT_GT(rope, 0.98 * 80 * 9.80665 - 1) << radius;
      EXPECT_LT(rope, 80 * 9.80665 + 1) << radius;
      EXPECT_NEAR(rope + std::abs(rail), 80 * 9.80665, 1e-3) << radius;
      EXPECT_LT(std::abs(reference::value(run, row, "body.door.vy")), 1e-6) << radius;
      EXPECT_EQ(reference::value(run, row, "joint.axle.stuck"), 1) << radius;
      EXPECT_EQ(reference::value(run, row, "joint.rail.stuck"), 1) << radius;
    }
  }
}

// Bristles that nothing presses exert no force, and grew without bound: the run failed when the load came. Each half swing then costs 2 M / k of the angle.
TEST(StickSlip, BristlesThatNothingHasPressedHoldAsOthersDo) {
  constexpr double kSpring = 1000, kInertia = 0.01, kFriction = 0.1 * 100 * 0.01;
  const double rate = std::sqrt(kSpring / kInertia), half_swings = (0.4 + 0.05) * rate / std::numbers::pi;  // at the full load; half as much on average on the ramp of 0.1 s
  for (const double tolerance : {1e-3, 1e-5}) {
    Model model = reference::test_model("wheel_on_unpressed_bristles");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    EXPECT_NEAR(std::hypot(reference::at_end(run, "body.wheel.angle"), reference::at_end(run, "body.wheel.spin") / rate), 300 / rate - half_swings * 2 * kFriction / kSpring, 1e-4) << tolerance;
  }
}

// When a surface begins to slip its friction jumps, within a step of 1e-14 s: a curve through that jump was 0.3 % above both sides.
TEST(StickSlip, ThePeakOfAFrictionThatJumpsIsOnOneOfItsSides) {
  for (const char* tolerance : {"1e-5", "1e-7"}) {
    const Trajectory run = completed(reference::test_model("ball_to_a_wall", {"body.ball.mass=1.04034", "body.ball.inertia=0.000942975", std::string("simulate.tolerance=") + tolerance}));
    const double normal = reference::value(run, 0, "joint.slope.contact_force");
    EXPECT_NEAR(run.joints.at(0).peak, normal * std::hypot(1, 0.35), 1e-4 * normal) << tolerance;
  }
}

// A pin whose normal force all but vanishes for a microsecond slips there, although it is stuck on both sides. The slip was missed, and friction then drove the joint.
TEST(StickSlip, ASlipWhereTheNormalForceAllButVanishesIsFound) {
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    Model model = reference::test_model("arm_with_rubbing_pins");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    const auto wrist = std::find_if(run.events.begin(), run.events.end(), [](const JointEvents& events) { return events.joint == "w"; });
    ASSERT_NE(wrist, run.events.end());
    ASSERT_GE(wrist->events.size(), 4u);
    EXPECT_NEAR(wrist->events[2].t, 0.00179292, 1e-7) << tolerance;
    for (std::size_t row = 0; row < run.n_rows(); ++row) {
      const bool slips = reference::value(run, row, "joint.w.stuck") == 0;
      EXPECT_GE(slips ? reference::value(run, row, "joint.w.friction_power") : 0, 0) << tolerance << " " << run.at(row, 0);
    }
  }
}

// Vibrations that friction makes grow were damped by steps longer than they are: all passes agreed on a peak that was 9 % too small.
TEST(StickSlip, AVibrationThatFrictionMakesGrowIsFollowed) {
  const auto run = [](double tolerance) {
    Model model = reference::test_model("chair_whose_foot_chatters");
    model.simulate.tolerance = tolerance;
    return completed(model);
  };
  const auto grows = [](const std::string& note) { return note.find("make a vibration of 51") != std::string::npos && note.find("steps were made short enough to follow it") != std::string::npos; };
  const Trajectory fine = run(1e-5);
  for (const double tolerance : {1e-3, 1e-4}) {
    const Trajectory coarse = run(tolerance);
    EXPECT_EQ(std::count_if(coarse.notes.begin(), coarse.notes.end(), grows), 1) << tolerance;
    for (std::size_t j = 0; j < coarse.joints.size(); ++j) EXPECT_NEAR(coarse.joints[j].peak, fine.joints[j].peak, tolerance * fine.joints[j].peak) << coarse.joints[j].name << tolerance;
  }
  EXPECT_NEAR(fine.joints.front().peak, 564.48, 0.01);  // by dopri5, and with steps of 1 ms at most, whatever the tolerance
}

}  // namespace
}  // namespace pintle
