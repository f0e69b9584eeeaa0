// Coulomb's friction where it sticks: it goes on with the force that it slipped with.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;

// A mass of 2 kg that a spring of k pulls along the floor, whose far end moves at a speed; of 10 m/s^2.
Model pulled_slider(double k, double speed, double kinetic, double stuck, double duration) {
  Model model = parse_model(reference::pulled_mass(10, fmt::format("friction = \"coulomb\"\nfriction_coefficient = {}\nstatic_friction = {}\n", kinetic, stuck), 2, k, speed), "pulled_slider.toml");
  model.simulate.duration = duration;
  model.simulate.output_step = 0.01;
  return model;
}

// Round numbers, where the speed comes to nothing just as a row or a step ends.
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

// A slider that is pulled ever harder breaks loose where the spring of its stiction carries the static friction: V t = F/k + F/k_t - c_t/k_t V k/k_t: stuck, it moves with V k/k_t.
TEST(StickSlip, BreaksLooseOnTime) {
  Model model = pulled_slider(100, 0.05, 0.3, 0.4, 2);
  model.simulate.tolerance = 1e-7;
  const Trajectory run = completed(model);
  const double F = 0.4 * 20, k = 100, speed = 0.05, k_t = 1e8, c_t = 1e5;
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events[0].events[0].what, "slips");
  EXPECT_NEAR(run.events[0].events[0].t * speed, F / k + F / k_t - c_t / k_t * speed * k / k_t, 1e-12);
}

// What a joint has turned into heat while it stuck is what its spring had stored, F^2/(2 k_t); while it slipped, friction times way.
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

// What gives way does not turn back a shaft that begins to turn, nor its friction. Torques, with the pressure F of the mesh, the tension T and the friction t.
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

// A block of 2 kg that is pushed to and fro on a dry guide sticks and slips; nothing holds it with more than static friction, whatever the method.
TEST(StickSlip, NoMethodTellsMoreThanStaticFriction) {
  constexpr double kWeight = 2 * kStandardGravity, kStuck = 0.4;
  for (const char* method : {"radau", "dopri5", "ode45", "ode15s", "ode113", "hht"}) {
    Model model = reference::test_model("block_pushed_to_and_fro");
    model.simulate.method = method;
    const Trajectory run = simulate(model);
    EXPECT_NEAR(run.joints.front().peak, std::hypot(kWeight, kStuck * kWeight), 1e-3 * kWeight) << method;
  }
}

}  // namespace
}  // namespace pintle
