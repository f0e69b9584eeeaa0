// Rubber that hardens and has internal friction, and friction along a slot, in whole runs against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::value;

// 20 kg on a pin of rubber: k r (1 + a r^2) = m g.
TEST(Rubber, AWeightSinksIntoItAsItHardens) {
  const Trajectory run = completed(parse_model(R"toml(
format = 1
[simulate]
duration = "0.1 s"
[ground.markers]
o = [0, 0]
[body.weight]
mass = 20
inertia = 0.1
position = [0, 0]
angle = 0
spin = 0
markers.o = [0, 0]
[joint.rubber]
type = "revolute"
between = ["ground.o", "weight.o"]
law = "maxwell"
stiffness = 1e5
damping = 300
hardening = 1e5
branch_ratio = [0.5]
branch_time = [0.05]
)toml",
                                                   "weight.toml"));
  double r = 1e-3;
  for (int i = 0; i < 50; ++i) r -= (1e5 * r * (1 + 1e5 * r * r) - 20 * kStandardGravity) / (1e5 * (1 + 3e5 * r * r));
  EXPECT_NEAR(value(run, 0, "body.weight.y"), -r, 1e-9);
  EXPECT_NEAR(at_end(run, "body.weight.y"), -r, 1e-7);
}

// A block that a servo moves by 2 mm to and fro, `speed` times per second, against rubber with an internal friction of 40 N over 0.5 mm.
Model moved_to_and_fro(double cycles, double speed) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = {:.17g}
output_step = {:.17g}
tolerance = 3e-4
[ground.markers]
ways = [0, 0]
across = [0, 0, "90 deg"]
[body.block]
mass = 1
inertia = 1e-3
position = [0, 0]
angle = 0
markers.ways = [0, 0]
[joint.ways]
type = "prismatic"
between = ["ground.ways", "block.ways"]
[joint.rubber]
type = "slot"
between = ["ground.across", "block.ways"]
law = "maxwell"
stiffness = 1e4
damping = 0
branch_ratio = [1e-9]
branch_time = [1]
hysteresis_force = 40
hysteresis_displacement = "0.5 mm"
[motor.servo]
joint = "ways"
position = "0.002*sin({:.17g}*t)"
stiffness = 1e9
damping = 1e4
)toml",
                                 cycles / speed, 0.02 / speed, 2 * std::numbers::pi * speed),
                     "to_and_fro.toml");
}

double heat(const Trajectory& run, const std::string& joint) {
  const auto found = std::find_if(run.joints.begin(), run.joints.end(), [&joint](const LoadSummary& one) { return one.name == joint; });
  return found == run.joints.end() ? -1 : found->heat;
}

// A steady cycle between -A and A loses 4 F (A - x tanh(A/x)), at any speed.
TEST(Rubber, ACycleLosesTheSameHoweverFast) {
  const double x = 0.5e-3, A = 2e-3, lost = 4 * 40 * (A - x * std::tanh(A / x));
  for (const double speed : {0.2, 5.0}) {
    const double cycle = heat(completed(moved_to_and_fro(4, speed)), "rubber") - heat(completed(moved_to_and_fro(3, speed)), "rubber");
    EXPECT_NEAR(cycle, lost, 5e-4 * lost) << speed;
  }
}

TEST(Rubber, WantsTheWayOverWhichItRubs) {
  const auto refused = [](const std::string& keys) {
    try {
      reference::mechanism("four_bar", {"--law joint.B=maxwell,branch_ratio=[1],branch_time=[0.01]," + keys});
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(refused("hysteresis_force=10").find("hysteresis_displacement"), std::string::npos);
  EXPECT_EQ(refused("hysteresis_force=10,hysteresis_displacement=1e-4"), "");
  EXPECT_EQ(refused("branch_ratio=[1,1,1,1,1,1],branch_time=[1,2,3,4,5,6],hardening=1e5"), "");  // hardening needs no states
}

// A pin pressed into its slot by 30 N.
Trajectory in_slot(double pull, double speed, double duration) {
  return completed(parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = {}
[ground.markers]
slot = [0, 0]
[body.pin]
mass = 2
inertia = 1e-2
position = [0, 0]
velocity = [{}, 0]
angle = 0
spin = 3
markers.p = [0, 0]
[joint.slot]
type = "slot"
between = ["ground.slot", "pin.p"]
friction = "coulomb"
friction_coefficient = 0.2
static_friction = 0.25
[force.push]
on = "pin.p"
force = [{}, -30]
)toml",
                                           duration, speed, pull),
                               "slot.toml"));
}

// Pulled along it by 10 N; friction of 0.2 times the pressing force holds it back.
TEST(SlotFriction, SlowsAPinAlongItsSlot) {
  const Trajectory run = in_slot(10, 0, 0.5);
  EXPECT_NEAR(at_end(run, "body.pin.x"), 0.5 * 2 * 0.25, 5e-4);  // (10 - 6)/2 m/s^2
  EXPECT_NEAR(at_end(run, "joint.slot.friction"), -6, 1e-4);
  EXPECT_NEAR(at_end(run, "body.pin.spin"), 3, 1e-9);
}

// 1 m/s against 6 N: 2 kg stop after a third of a second.
TEST(SlotFriction, ANoteSaysWhenItCameToRestForGood) {
  const auto says = [](const Trajectory& run, const std::string& words) { return std::any_of(run.notes.begin(), run.notes.end(), [&words](const std::string& note) { return note.find(words) != std::string::npos; }); };
  const Trajectory stopped = in_slot(0, 1, 1), moving = in_slot(10, 1, 1);
  EXPECT_NEAR(at_end(stopped, "body.pin.x"), 1.0 / 6, 1e-3);
  EXPECT_TRUE(says(stopped, "joint slot sticks from t = 0.33"));
  EXPECT_FALSE(says(moving, "sticks"));
}

}  // namespace
}  // namespace pintle
