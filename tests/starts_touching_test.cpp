// Bodies that start on their supports press on them from the first row on. theory/assembly section 3.
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

using reference::value;

// The second marker stays above the x axis of the first one, by the radius at least; a spring of 1e8 N/m with a power of the depth.
std::string contact(const std::string& name, const std::string& first, const std::string& second, double radius, double exponent = 1) {
  return fmt::format("[joint.{}]\ntype = \"slot\"\nbetween = [\"{}\", \"{}\"]\nlaw = \"contact\"\npin_radius = {}\ncontact_stiffness = 1e8\ncontact_exponent = {}\n", name, first, second, radius, exponent);
}

// Starts in contact may ring; these do not, and no note says that they may.
Trajectory quiet_touching_run(const std::string& text) {
  Trajectory run = simulate(parse_model("format = 1\n" + text, "touching"));
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  for (const std::string& note : run.notes) EXPECT_EQ(note.find("transient-free"), std::string::npos) << note;
  return run;
}

const std::string kDiscOnIncline = R"toml(
[simulate]
duration = "0.5 s"
[ground.markers]
plane = [0, 0, "-30 deg"]
[body.disc]
mass = 3
inertia = 0.06
position = ["0.2 m*sin(30 deg)", "0.2 m*cos(30 deg)"]
markers.c = [0, 0]
)toml";

TEST(StartsTouching, ADiscOnAnInclinePressesByItsWeightAllTheTime) {
  const double exact = 3 * kStandardGravity * std::cos(kPi / 6);
  for (const double exponent : {1.0, 1.5}) {
    const LoadSummary road = quiet_touching_run(kDiscOnIncline + contact("road", "ground.plane", "disc.c", 0.2, exponent)).joints.at(0);
    EXPECT_NEAR(road.peak, exact, 1e-6 * exact) << exponent;
    EXPECT_NEAR(road.rms, exact, 1e-6 * exact) << exponent;
  }
}

TEST(StartsTouching, ADiscThatSlidesOntoALaneRubsFromTheStart) {
  const Trajectory run = quiet_touching_run(R"toml(
[simulate]
duration = "1 s"
[ground.markers]
lane = [0, 0]
[body.disc]
mass = 7
inertia = "7 kg*(0.11 m)^2/2"
position = [0, 0.11]
velocity = [8, 0]
markers.c = [0, 0]
)toml" + contact("lane", "ground.lane", "disc.c", 0.11, 1.5) + "friction_coefficient = 0.12\n");
  const double exact = 7 * kStandardGravity * std::sqrt(1 + 0.12 * 0.12);
  EXPECT_NEAR(run.joints.at(0).peak, exact, 1e-5 * exact);
}

// N = m (g + v^2 / (R - r)) at the bottom of a half pipe, without friction.
TEST(StartsTouching, ABallAtTheBottomOfAPipeIsCarriedRoundTheBend) {
  const Trajectory run = quiet_touching_run(R"toml(
[simulate]
duration = "0.3 s"
[ground.markers]
o = [0, 0]
[body.ball]
mass = 2
inertia = 1e-3
position = [0, -0.9]
velocity = [1.5, 0]
markers.c = [0, 0]
[joint.pipe]
type = "edge"
between = ["ground.o", "ball.c"]
height = "-sqrt((1 m)^2 - x^2)"
from = -0.7
to = 0.7
roller_radius = 0.1
law = "contact"
contact_stiffness = 1e8
contact_exponent = 1
)toml");
  const double exact = 2 * (kStandardGravity + 1.5 * 1.5 / 0.9);
  EXPECT_NEAR(run.joints.at(0).peak, exact, 1e-5 * exact);
}

const std::string kRodOnWall = R"toml(
[simulate]
duration = "0.3 s"
[ground.markers]
floor = [0, 0]
wall = [0, 0, "-90 deg"]
[body.rod]
mass = 4
inertia = "4 kg*(2 m)^2/12"
position = ["1 m*cos(60 deg)", "1 m*sin(60 deg)"]
angle = "-60 deg"
markers.foot = [1, 0]
markers.head = [-1, 0]
)toml" + contact("floor", "ground.floor", "rod.foot", 0) + contact("wall", "ground.wall", "rod.head", 0);

// Wall: 3/4 m g sin cos; floor: m g (1 - 3/4 cos^2).
TEST(StartsTouching, ARodBetweenWallAndFloorFallsWithTheReactionsOfItsBeginning) {
  const Trajectory run = quiet_touching_run(kRodOnWall);
  const double weight = 4 * kStandardGravity, s = std::sin(kPi / 3), c = std::cos(kPi / 3);
  EXPECT_NEAR(value(run, 0, "joint.wall.contact_force"), 0.75 * weight * s * c, 1e-4 * weight);
  EXPECT_NEAR(value(run, 0, "joint.floor.contact_force"), weight * (1 - 0.75 * c * c), 1e-4 * weight);
  EXPECT_LE(run.joints.at(1).peak, 0.75 * weight * s * c * (1 + 1e-3));
}

// The centre of a plank is outside its two supports: the far one would have to hold it down. About the near one, N = m g k^2 / (k^2 + d^2).
TEST(StartsTouching, ASupportThatWouldHavePulledDoesNot) {
  const std::string supports = R"toml(
[simulate]
duration = "0.05 s"
[ground.markers]
far = [-0.6, 0]
near = [-0.2, 0]
[body.plank]
mass = 5
inertia = 0.9
position = [0, 0]
markers.far = [-0.6, 0, "180 deg"]
markers.near = [-0.2, 0, "180 deg"]
)toml";
  const Trajectory run = quiet_touching_run(supports + contact("far", "plank.far", "ground.far", 0) + contact("near", "plank.near", "ground.near", 0));
  const double exact = 5 * kStandardGravity * 0.18 / (0.18 + 0.04);
  EXPECT_EQ(run.joints.at(0).peak, 0);
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.starts_with("surfaces that touch at the start without pressing on each other: far;"); }));
  EXPECT_NEAR(value(run, 0, "joint.near.contact_force"), exact, 1e-4 * exact);
  EXPECT_LE(run.joints.at(1).peak, exact * (1 + 1e-2));
}

// A touch with an approach speed is an impact.
TEST(StartsTouching, ABallThatFallsOntoTheFloorAsTheRunBeginsBounces) {
  const Trajectory run = simulate(parse_model(R"toml(format = 1
[simulate]
duration = "0.1 s"
[ground.markers]
floor = [0, 0]
[body.ball]
mass = 1
inertia = 1e-3
position = [0, 0.05]
velocity = [0, -1]
markers.c = [0, 0]
)toml" + contact("floor", "ground.floor", "ball.c", 0.05, 1.5) + "restitution = 0.5\n", "bounce"));
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
  double fastest = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) fastest = std::max(fastest, value(run, row, "body.ball.vy"));
  EXPECT_NEAR(fastest, 0.5, 0.02);
}

// Assembly does not change the velocity of a body that is joined only by a slack rope.
TEST(StartsTouching, ASlackRopeLeavesItsBallTheVelocityThatIsStated) {
  const Trajectory run = reference::completed(reference::test_model("rope_that_snaps", {"simulate.duration=0.01"}));
  EXPECT_NEAR(value(run, 0, "body.ball.vx"), 1, 1e-12);
  EXPECT_NEAR(value(run, 0, "body.ball.vy"), 2, 1e-12);
}

// The latch's contact creeps under its load more slowly than anything else moves. The slow motion on which it was taken to start had seven times the load.
TEST(StartsTouching, ALatchWhoseToeSticksCarriesTheTorqueAndNoMore) {
  const Trajectory run = reference::completed(reference::test_model("latch_that_sticks"));
  const double exact = 20 * kPi / 2 / 0.1;  // the torque of the spring at the arm of the toe
  EXPECT_NEAR(value(run, 0, "joint.catch.contact_force"), exact, 1e-3 * exact);
  for (const LoadSummary& joint : run.joints) EXPECT_LE(joint.peak, exact * (1 + 2e-3)) << joint.name;
}

// Contacts that hardly touch are so soft that the person would sink between them: they are given the stiffness that they have under the load.
TEST(StartsTouching, APersonStandsOnHeelAndToe) {
  const Trajectory run = reference::completed(reference::test_model("standing_person"));
  const double weight = 70 * 9.80665, of_foot = 1.2 * 9.80665, toe = (weight * 0.05 + of_foot * 0.1) / 0.23;
  EXPECT_NEAR(value(run, 0, "joint.toe.contact_force"), toe, 2e-2 * toe);  // the foot tips by 0.6 deg where its heel sinks in
  EXPECT_NEAR(value(run, 0, "joint.heel.contact_force"), weight + of_foot - toe, 1e-2 * weight);
  for (const LoadSummary& joint : run.joints) EXPECT_LE(joint.peak, joint.rms * (1 + 1e-3)) << joint.name;
}

}  // namespace
}  // namespace pintle
