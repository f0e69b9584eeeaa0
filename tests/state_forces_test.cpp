// Forces that depend on positions and velocities of bodies, against springs that do the same. A published case: reference_macpherson_test.cpp.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "pintle/check.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A block on a prismatic guide, held by a spring and a damper, or by a force that reads its position and speed.
std::string held_by(const char* what, const char* equations = "newtonian") {
  return fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
tolerance = 1e-7
equations = "{}"
[ground.markers]
o = {{ x = 0, y = 0 }}
[body.block]
mass = 2
inertia = 0.01
position = [1.3, 0]
velocity = [0.2, 0]
angle = 0
markers.c = {{ x = 0, y = 0 }}
[joint.guide]
type = "prismatic"
between = ["ground.o", "block.c"]
{}
)toml",
                     equations, what);
}

TEST(StateForces, ASpringWrittenAsAForceIsThatSpring) {
  const std::string spring = "[spring.s]\nbetween = [\"ground.o\", \"block.c\"]\nstiffness = 50\ndamping = 0.7\nfree_length = 1";
  for (const char* force : {"[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(block.x - 1 m) - 0.7 N*s/m*block.vx\", 0]",
                            "[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(block.c.x - 1 m) - 0.7 N*s/m*block.c.vx\", 0]",
                            "[force.f]\non = \"block.c\"\nforce = [\"-50 N/m*(guide.slide - 1 m) - 0.7 N*s/m*guide.rate\", 0]"})
    for (const char* equations : {"newtonian", "relative", "ideal"}) {
      const Trajectory a = simulate(parse_model(held_by(spring.c_str(), equations), "spring.toml")), b = simulate(parse_model(held_by(force, equations), "force.toml"));
      ASSERT_EQ(b.outcome, Outcome::kCompleted) << force << b.message;
      const auto x = static_cast<std::size_t>(a.column("body.block.x")), y = static_cast<std::size_t>(b.column("body.block.x"));
      for (std::size_t i = 0; i < a.n_rows(); i += 25) EXPECT_NEAR(b.at(i, y), a.at(i, x), 1e-9) << force << ' ' << equations;
    }
}

// A torque that reads the angle of a body from a marker turned relative to it.
TEST(StateForces, ATorqueReadsTheAngleOfItsMarker) {
  const Trajectory run = simulate(parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
tolerance = 1e-8
[ground.markers]
o = { x = 0, y = 0 }
[body.wheel]
mass = 2
inertia = 0.5
position = [0, 0]
angle = "0.1 rad"
spin = 0
markers.o = { x = 0, y = 0 }
markers.m = { x = 0.1, y = 0, axis = "0.2 rad" }
[joint.pin]
type = "revolute"
between = ["ground.o", "wheel.o"]
[force.f]
on = "wheel.o"
torque = "-8 N*m/rad*(wheel.m.angle - 0.2 rad)"
)toml",
                                              "torque.toml"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const auto angle = static_cast<std::size_t>(run.column("body.wheel.angle"));
  EXPECT_NEAR(run.at(run.n_rows() - 1, angle), 0.1 * std::cos(4.0), 1e-7);  // sqrt(8 / 0.5) = 4 rad/s
}

// A thruster at the corner of a body that flies and turns: its force, which falls as the speed grows, in the body's axes and in the world's.
std::string thrusted_by(const char* axes, const char* force, const char* equations) {
  return fmt::format(R"toml(
format = 1
[simulate]
duration = "2 s"
tolerance = 1e-7
equations = "{}"
[ground.markers]
o = [0, 0]
[body.craft]
mass = 2
inertia = 0.3
position = [0, 0]
angle = 0.3
velocity = [1, 2]
spin = 0.5
markers.c = [0, 0]
markers.jet = [-0.2, 0.1, "40 deg"]
[body.bob]
mass = 0.5
inertia = 0.01
position = [0, -1]
angle = 0
markers.top = [0, 0.6]
[joint.pin]
type = "revolute"
between = ["craft.c", "bob.top"]
[force.jet]
on = "craft.jet"
axes = "{}"
force = {}
)toml",
                     equations, axes, force);
}

TEST(StateForces, InTheAxesOfTheBodyTheyAreThoseInTheWorldTurnedWithIt) {
  const std::string x = "(30 N - 4 N*s/m*craft.vx)", y = "(2 N*s/rad*craft.spin + 5 N/m*bob.y)", c = "cos(craft.angle)", s = "sin(craft.angle)";
  const std::string in_body = fmt::format("[\"{}\", \"{}\"]", x, y), in_world = fmt::format("[\"{0}*{2} - {1}*{3}\", \"{0}*{3} + {1}*{2}\"]", x, y, c, s);
  for (const char* equations : {"newtonian", "ideal"}) {
    const Trajectory body = simulate(parse_model(thrusted_by("body", in_body.c_str(), equations), "body.toml")), world = simulate(parse_model(thrusted_by("world", in_world.c_str(), equations), "world.toml"));
    ASSERT_EQ(body.outcome, Outcome::kCompleted) << body.message;
    ASSERT_EQ(world.outcome, Outcome::kCompleted) << world.message;
    for (std::size_t i = 0; i < body.n_rows(); i += 20)
      for (const char* name : {"body.craft.x", "body.craft.y", "body.craft.angle", "joint.pin.on_bob.fx[world]", "joint.pin.on_bob.fy[world]", "energy.supplied"})
        EXPECT_NEAR(reference::value(body, i, name), reference::value(world, i, name), 2e-6 * (1 + std::abs(reference::value(world, i, name)))) << name << ' ' << i << ' ' << equations;
  }
  const CheckReport report = check_model(parse_model(thrusted_by("body", in_body.c_str(), "newtonian"), "body.toml"));
  EXPECT_TRUE(report.jacobians.passed());
  EXPECT_TRUE(report.energy.passed());
}

// In world axes, whether a force depends on t or reads the state, and whether it is given along the axes of the world or of its body.
TEST(StateForces, AreColumnsWithTheirPower) {
  const Trajectory run = reference::completed(parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
output_step = "0.1 s"
[body.b]
mass = 2
inertia = 0.5
position = [1, 2]
angle = "30 deg"
velocity = [0.3, -0.1]
spin = 0.7
markers.c = [0.3, -0.2]
[force.of_time]
on = "b.c"
axes = "body"
force = ["3 N*t/1 s", 1]
torque = 0.2
[force.of_place]
on = "b.c"
axes = "body"
force = ["-2 N/m*b.x", "0.5 N"]
[force.in_world]
on = "b.c"
force = ["-1 N*s/m*b.c.vx", "4 N/m*b.y"]
torque = "0.1 N*m*s*b.spin"
)toml", "forces.toml"));
  EXPECT_EQ(run.column("force.of_place.torque"), -1);
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const auto at = [&](const std::string& column) { return reference::value(run, row, column); };
    const double angle = at("body.b.angle"), c = std::cos(angle), s = std::sin(angle), spin = at("body.b.spin");
    const double rx = 0.3 * c + 0.2 * s, ry = 0.3 * s - 0.2 * c;
    const double vx = at("body.b.vx") - spin * ry, vy = at("body.b.vy") + spin * rx;
    const auto expect = [&](const std::string& name, double fx, double fy, double torque) {
      const double scale = 1e-12 * (1 + std::abs(fx) + std::abs(fy));
      EXPECT_NEAR(at("force." + name + ".fx[world]"), fx, scale) << name << " row " << row;
      EXPECT_NEAR(at("force." + name + ".fy[world]"), fy, scale) << name << " row " << row;
      if (torque != 0) {
        EXPECT_NEAR(at("force." + name + ".torque"), torque, 1e-12) << name << " row " << row;
      }
      EXPECT_NEAR(at("force." + name + ".power"), fx * vx + fy * vy + torque * spin, 1e-12 + scale * (std::abs(vx) + std::abs(vy))) << name << " row " << row;
    };
    const double t = at("t"), f = -2 * at("body.b.x");
    expect("of_time", c * 3 * t - s, s * 3 * t + c, 0.2);
    expect("of_place", c * f - s * 0.5, s * f + c * 0.5, 0);
    expect("in_world", -vx, 4 * at("body.b.y"), 0.1 * spin);
  }
}

}  // namespace
}  // namespace pintle
