// Rods and ropes whose length is a function of time: winches and pendulums against their own equations.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "pintle/complaint.h"
#include "pintle/read_model.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::drift;

constexpr double kWeightPerMass = 9.81, kLoad = 200;

// A load on the hook of a winch.
Model winch(const std::string& length, const std::string& duration, double stiffness = 1e8) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, {}]
[simulate]
duration = "{}"
tolerance = 1e-6
[ground.markers]
drum = [0, 6]
[body.load]
mass = {}
inertia = 10
position = [0, 1]
angle = 0
markers.hook = [0, 0]
[joint.rope]
type = "rope"
between = ["ground.drum", "load.hook"]
length = "{}"
stiffness = {}
damping = 2e4
)toml",
                                 -kWeightPerMass, duration, kLoad, length, stiffness),
                     "winch.toml");
}

double most_of(const Trajectory& run, const std::string& column) {
  double most = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) most = std::max(most, std::abs(reference::value(run, i, column)));
  return most;
}

// Lifting from rest at the acceleration a, the rope carries m (g + a), and the winch delivers the power F a t.
TEST(DrivenLength, AWinchCarriesTheLoadAndItsAcceleration) {
  const double a = 0.8, end = 2;
  const std::string column = "joint.rope.on_load.fy[world]";
  for (const bool rope : {false, true}) {
    Model model = winch("5 m - 0.5*0.8 m/s^2*t^2", "2 s");
    model.joints[0].type = rope ? "rope" : "rod";
    model.simulate.equations = rope ? Equations::kNewtonian : Equations::kRelative;
    if (rope) {  // ropes start unloaded, unless they are stretched already
      model.simulate.start = Start::kRaw;
      model.bodies[0].position = {0, 1 - kLoad * (kWeightPerMass + a) / 1e8};
      model.bodies[0].velocity = {0, 0};
      model.bodies[0].spin = 0;
    }
    const Trajectory run = completed(model);
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      EXPECT_NEAR(reference::value(run, i, column), kLoad * (kWeightPerMass + a), 1e-5 * kLoad * kWeightPerMass);
      EXPECT_NEAR(reference::value(run, i, "joint.rope.drive_power"), kLoad * (kWeightPerMass + a) * a * reference::value(run, i, "t"), 1e-4 * kLoad * kWeightPerMass);
      EXPECT_NEAR(reference::value(run, i, "joint.rope.length"), 5 - 0.5 * a * std::pow(reference::value(run, i, "t"), 2), 1e-12);
    }
    const double height = 0.5 * a * end * end;
    EXPECT_NEAR(run.energy.supplied, kLoad * (kWeightPerMass + a) * height, 1e-5 * kLoad * kWeightPerMass * height);
    EXPECT_LT(drift(run), 1e-6 * kLoad * kWeightPerMass * height);
  }
}

// A rod of driven length is a moving constraint: its multiplier is the same force.
TEST(DrivenLength, AnIdealRodIsALinkWhoseLengthIsGiven) {
  Model model = winch("5 m - 0.5*0.8 m/s^2*t^2", "2 s");
  model.joints[0].type = "rod";
  model.simulate.equations = Equations::kIdeal;
  const Trajectory run = completed(model);
  for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(reference::value(run, i, "joint.rope.on_load.fy[world]"), kLoad * (kWeightPerMass + 0.8), 1e-5 * kLoad * kWeightPerMass);
  EXPECT_NEAR(run.energy.supplied, kLoad * (kWeightPerMass + 0.8) * 1.6, 1e-3);
  EXPECT_LT(drift(run), 1e-4);
}

// L th'' + 2 L' th' + g sin th = 0.
TEST(DrivenLength, APendulumOfChangingLengthFollowsItsEquation) {
  const auto length = [](double t) { return 1 + 0.2 * std::sin(3 * t); };
  const auto rate = [](double t) { return 0.6 * std::cos(3 * t); };
  Model model = parse_model(R"toml(
format = 1
gravity = [0, -9.81]
[simulate]
duration = "3 s"
tolerance = 1e-7
[ground.markers]
pin = [0, 0]
[body.bob]
mass = 1
inertia = 0.01
position = [0.6, -0.8]
angle = 0
spin = 0
markers.c = [0, 0]
[joint.arm]
type = "rod"
between = ["ground.pin", "bob.c"]
length = "1 m + 0.2 m*sin(3 rad/s*t)"
stiffness = 1e9
damping = 1e5
)toml",
                            "pendulum.toml");
  const double angle = std::atan2(0.6, 0.8);
  std::array<double, 2> y{angle, 0};
  const auto slope = [&](double t, const std::array<double, 2>& at) -> std::array<double, 2> { return {at[1], -(2 * rate(t) * at[1] + kWeightPerMass * std::sin(at[0])) / length(t)}; };
  constexpr int kSteps = 30000;
  const double h = 3.0 / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const auto ahead = [&](const std::array<double, 2>& k, double step) -> std::array<double, 2> { return {y[0] + step * k[0], y[1] + step * k[1]}; };
    const double t = i * h;
    const auto k1 = slope(t, y), k2 = slope(t + h / 2, ahead(k1, h / 2)), k3 = slope(t + h / 2, ahead(k2, h / 2)), k4 = slope(t + h, ahead(k3, h));
    for (int n = 0; n < 2; ++n) y[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
  }
  // m (L th'^2 + g cos th - L'') is what the rod carries.
  const double force = length(3) * y[1] * y[1] + kWeightPerMass * std::cos(y[0]) + 1.8 * std::sin(9.0);
  for (const Equations equations : {Equations::kNewtonian, Equations::kIdeal}) {
    model.simulate.equations = equations;
    const Trajectory run = completed(model);
    EXPECT_NEAR(at_end(run, "body.bob.x"), length(3) * std::sin(y[0]), 1e-6);
    EXPECT_NEAR(at_end(run, "body.bob.y"), -length(3) * std::cos(y[0]), 1e-6);
    EXPECT_NEAR(std::hypot(at_end(run, "joint.arm.on_bob.fx[world]"), at_end(run, "joint.arm.on_bob.fy[world]")), force, 1e-4);
    EXPECT_LT(drift(run), 1e-5);
  }
}

// When it is let down faster than its load falls, the rope is slack, and the load falls freely.
TEST(DrivenLength, ARopeLetDownFasterThanItsLoadFallsIsSlack) {
  const Trajectory run = completed(winch("5 m + 6 m/s^2*t^2", "0.3 s"));
  EXPECT_LT(std::abs(at_end(run, "joint.rope.on_load.fy[world]")), 1e-9);
  EXPECT_NEAR(at_end(run, "body.load.vy"), -kWeightPerMass * 0.3, 1e-3);
  EXPECT_LT(most_of(run, "joint.rope.drive_power"), 1e-2 * kLoad * kWeightPerMass);
}

// A rope cannot be wound up beyond its end: a negative length would push.
TEST(DrivenLength, ARunEndsWhereNoLengthIsLeft) {
  const Trajectory run = simulate(winch("5 m - 20 m/s*t", "0.3 s"));
  EXPECT_EQ(run.outcome, Outcome::kEnergyOpen);
  EXPECT_NE(run.message.find("the length of joint rope has shrunk to 0 by t = 0.25"), std::string::npos) << run.message;
  EXPECT_LT(run.t_end, 0.26);
}

TEST(DrivenLength, AWrongLengthIsRefused) {
  EXPECT_THROW(winch("1 m*t", "1 s"), InputError);
  EXPECT_THROW(winch("5 m - 2 m*t", "1 s"), InputError);  // metre times second
  const Model model = winch("2*2.5 m", "1 s");
  EXPECT_TRUE(model.joints[0].functions.empty());
  EXPECT_EQ(model.joints[0].geometry.at("length"), 5);
}

// A rope with a load of 10 kg becomes 10 mm shorter at once: the work of the winch on its stretch, beyond the lifting of the load, ends as heat in the rope.
TEST(DrivenLength, AJumpOfItHeatsTheRopeByHalfOfItsStretch) {
  const Trajectory run = reference::completed(parse_model(R"toml(format = 1
[simulate]
duration = "1 s"
[ground.markers]
a = [0, 0]
[body.load]
mass = "10 kg"
inertia = "0.1 kg*m^2"
position = [0, "-1 m"]
angle = 0
markers.a = [0, 0]
[joint.line]
type = "rope"
between = ["ground.a", "load.a"]
length = "if(t < 0.5 s, 1 m, 0.99 m)"
stiffness = "1e5 N/m"
damping = "500 N*s/m"
)toml", "winch.toml"));
  EXPECT_NEAR(run.joints.at(0).heat, 0.5 * 1e5 * 0.01 * 0.01, 1e-4);
  EXPECT_NEAR(run.joints.at(0).heat, run.energy.dissipated, 1e-4);
}

// Thread and rod begin with the tension given by their stretch, and a spring balances them.
TEST(DrivenLength, ATieBeginsStretched) {
  for (const char* type : {"rope", "rod"}) {
    const Trajectory run = reference::completed(parse_model(std::string(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.1 s"
[ground.markers]
o = [0, 0]
anchor = ["160 mm", 0]
[body.shuttle]
mass = "50 g"
inertia = "1e-5 kg*m^2"
position = ["80 mm", 0]
angle = 0
markers.c = [0, 0]
[joint.rail]
type = "prismatic"
between = ["ground.o", "shuttle.c"]
[spring.s]
between = ["ground.anchor", "shuttle.c"]
stiffness = "100 N/m"
preload = "8 N"
[joint.tie]
between = ["ground.o", "shuttle.c"]
stiffness = "800 N/m"
stretch = "10 mm"
type = ")toml") + type + "\"\n", "tie.toml"));
    EXPECT_NEAR(run.joints.at(1).peak, 8, 1e-6) << type;
    EXPECT_NEAR(reference::at_end(run, "body.shuttle.x"), 0.08, 1e-9) << type;
  }
}

}  // namespace
}  // namespace pintle
