// Joints that nothing presses, and motors with nothing to drive, start without a force. theory/assembly sections 4 and 6.
#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A follower that hangs under its cam, free to fall, while the cam's pin deflects under the cam's weight.
TEST(StartsWithoutLoad, AFollowerFallsAwayFromItsCam) {
  const Model model = parse_model(R"toml(
format = 1
[simulate]
duration = "0.1 s"
[ground.markers]
O = [0, 0]
way = [0, 0, "90 deg"]
[body.cam]
mass = "3 kg"
inertia = "5e-3 kg*m^2"
position = [0, 0]
angle = 0
spin = 0
hold = ["angle"]
markers.O = [0, 0]
[body.pusher]
mass = "1.5 kg"
inertia = "2e-3 kg*m^2"
position = [0, "-6 mm"]
velocity = [0, 0]
angle = 0
markers.roller = [0, "-50 mm"]
markers.c = [0, 0, "90 deg"]
[joint.O]
type = "revolute"
between = ["ground.O", "cam.O"]
[joint.way]
type = "prismatic"
between = ["ground.way", "pusher.c"]
[joint.cam]
type = "cam"
between = ["cam.O", "pusher.roller"]
base_radius = "50 mm"
roller_radius = "6 mm"
lift = "0 m"
law = "contact"
contact_stiffness = 1e8
contact_exponent = 1
)toml",
                                  "hanging.toml");
  const Trajectory run = reference::completed(model);
  EXPECT_EQ(run.joints[2].name, "cam");
  EXPECT_EQ(run.joints[2].peak, 0);
  EXPECT_NEAR(run.joints[0].peak, 3 * kStandardGravity, 1e-4);
}

// A mass that rides on a belt at the belt's speed, on a spring that is not stretched yet: the belt's motor has nothing to do at first, whatever the mass weighs.
// The mass sticks until the spring force reaches static friction, mu_s m g = k v t.
TEST(StartsWithoutLoad, AMotorWithNothingToDoHasNoForce) {
  const Model model = parse_model(R"toml(
format = 1
[simulate]
duration = "0.3 s"
output_step = "1 ms"
[ground.markers]
O = [0, 0]
w = [-2, 0]
[body.belt]
mass = 50
inertia = 1
position = [0, 0]
angle = 0
velocity = [0.1, 0]
markers.c = [0, 0]
[body.m]
mass = 2
inertia = 0.01
position = [0, 0]
angle = 0
velocity = [0.1, 0]
markers.c = [0, 0]
[joint.guide]
type = "prismatic"
between = ["ground.O", "belt.c"]
[joint.rub]
type = "prismatic"
between = ["belt.c", "m.c"]
friction = "coulomb"
friction_coefficient = 0.2
static_friction = 0.3
[motor.drive]
joint = "guide"
speed = "0.1 m/s"
[spring.s]
between = ["ground.w", "m.c"]
stiffness = "200 N/m"
free_length = 2
)toml",
                                  "belt.toml");
  const Trajectory run = reference::completed(model);
  EXPECT_NEAR(reference::value(run, 0, "motor.drive.effort"), 0, 0.05);
  const double friction = 0.3 * 2 * kStandardGravity, loose = friction / (200 * 0.1);
  EXPECT_NEAR(run.motors[0].peak_effort, friction, 0.03 * friction);
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events[0].events.back().t, loose, 1e-3 * loose);
}

// Nothing acts at the start, so there is no force by which to measure errors.
TEST(StartsWithoutLoad, AMotorThatIsSwitchedOnSlowlyTurnsIdealJoints) {
  Model model = parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1.2 s"
equations = "ideal"
[ground.markers]
axis = [0, 0]
[body.table]
mass = "10 kg"
inertia = "0.2 kg*m^2"
position = [0, 0]
angle = 0
spin = 0
markers.axis = [0, 0]
[joint.axis]
type = "revolute"
between = ["ground.axis", "table.axis"]
[motor.indexer]
joint = "axis"
torque = "26 N*m*(1 - exp(-t/(10 ms)))"
)toml",
                            "table.toml");
  for (const Equations equations : {Equations::kIdeal, Equations::kPenalty}) {
    model.simulate.equations = equations;
    const Trajectory run = reference::completed(model);
    const double spin = 26 / 0.2 * (1.2 - 0.01);
    EXPECT_NEAR(reference::at_end(run, "body.table.spin"), spin, 1e-5 * spin);
  }
}

}  // namespace
}  // namespace pintle
