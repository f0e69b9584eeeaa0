// Forces that read where bodies are and how they move: against springs that do the same. A published one: reference_macpherson_test.cpp.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A block on a prismatic guide, held by a spring and a damper, or by a force that reads its place and speed.
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

// A torque that reads the angle of a body, from a marker turned against it.
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

TEST(StateForces, InTheAxesOfTheBodyTheyReadTimeOnly) {
  const std::string force = "[force.f]\non = \"block.c\"\naxes = \"body\"\nforce = [\"-50 N/m*block.x\", 0]";
  try {
    parse_model(held_by(force.c_str()), "force.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("block.x acts in the world's axes"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pintle
