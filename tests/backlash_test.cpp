// Gears and racks with play between their flanks: free travel in closed form, impacts of two inertias, energy.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/contact_runs.h"

namespace pintle {
namespace {

using contacts::follow;
using contacts::Followed;
using reference::at_end;
using reference::completed;
using reference::drift;

constexpr double kR1 = 0.1, kR2 = 0.2, kI1 = 0.02, kI2 = 0.3, kPlay = 2e-3, kRestitution = 0.6;

// Two gears on pins that are much stiffer than their teeth, so that only the teeth make the impacts; the first gear spins at 10 rad/s, the second is at rest.
Model gears(const std::string& more, const std::string& duration) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "{}"
start = "raw"
[ground.markers]
a = [0, 0]
b = [0.3, 0]
[body.first]
mass = 2
inertia = {}
position = [0, 0]
velocity = [0, 0]
angle = 0
spin = 10
markers.c = [0, 0]
[body.second]
mass = 8
inertia = {}
position = [0.3, 0]
velocity = [0, 0]
angle = 0
spin = 0
markers.c = [0, 0]
[joint.pin_a]
type = "revolute"
between = ["ground.a", "first.c"]
stiffness = 1e10
damping = 1e5
[joint.pin_b]
type = "revolute"
between = ["ground.b", "second.c"]
stiffness = 1e10
damping = 1e5
[joint.mesh]
type = "gear"
between = ["first.c", "second.c"]
radii = [0.1, 0.2]
law = "backlash"
backlash = {}
contact_stiffness = 1e6
restitution = {}
least_approach_speed = 1e-6
{}
)toml",
                                 duration, kI1, kI2, kPlay, kRestitution, more),
                     "gears.toml");
}

// From the middle of the play to a flank, then across it at e times the speed: 1 mm at 1 m/s, 2 mm at 0.6 m/s, 2 mm at 0.36 m/s.
TEST(Backlash, GearsCrossTheirPlayBetweenImpacts) {
  const Followed run = follow(gears("", "0.02 s"), 1e-8, 0.02, {});
  ASSERT_GE(run.contacts.size(), 5u);
  double slip = kR1 * 10;
  EXPECT_NEAR(run.contacts[0].t, 0.5 * kPlay / slip, 1e-6);
  for (std::size_t i = 1; i + 1 < run.contacts.size() && i < 4; i += 2) {
    slip *= kRestitution;
    EXPECT_NEAR(run.contacts[i + 1].t - run.contacts[i].t, kPlay / slip, 2e-3 * kPlay / slip) << i;
  }
  // The flanks push both gears with the same force: I1 w1 / r1 and I2 w2 / r2 change by the same amount.
  EXPECT_NEAR(kI1 * (10 - run.end.v[0][2]) / kR1, -kI2 * run.end.v[1][2] / kR2, 1e-6);
}

// A torque on the first gear, and a larger one, which a spring holds, on the second: the front flank carries T1 / r1.
TEST(Backlash, TheFlankCarriesTheTorqueThatIsPassedOn) {
  Model model = gears(R"toml(
[motor.drive]
joint = "pin_a"
torque = "3 N*m"
[torsion_spring.load]
between = ["ground.b", "second.c"]
stiffness = 400
damping = 30
free_angle = 0
)toml",
                      "3 s");
  model.bodies[0].spin = 0;
  model.joints[2].law.values["least_approach_speed"] = {1e-3};
  const Trajectory run = completed(model);
  EXPECT_NEAR(at_end(run, "joint.mesh.tooth_force"), 3 / kR1, 0.02 * 3 / kR1);
  EXPECT_NEAR(std::abs(at_end(run, "joint.mesh.flank")), 1, 0);
  EXPECT_NEAR(at_end(run, "body.second.angle"), -3 * kR2 / kR1 / 400, 0.02 * 0.015);
  EXPECT_LT(drift(run), 1e-3);
  ASSERT_FALSE(run.events.empty());
  EXPECT_NE(run.events[0].events[0].what.find("touch of the "), std::string::npos);
  EXPECT_NE(run.events[0].events[0].what.find(" flank"), std::string::npos);
}

}  // namespace
}  // namespace pintle
