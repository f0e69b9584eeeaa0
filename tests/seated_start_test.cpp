// start = "seated": joints with play begin where their load presses them, and carry what the motion needs from the first row on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "pintle/simulate.h"
#include "results/disk.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::mechanism;
using reference::value;

const std::string kSeated = "simulate.start=\"seated\"";

bool notes_have(const Trajectory& run, const std::string& words) {
  return std::any_of(run.notes.begin(), run.notes.end(), [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

// A rod of 2 kg and 1 m on a pin with a tenth of a millimetre of play, released 30 deg from hanging, or at rest straight down.
std::string rod(const std::string& angle, const std::string& gravity = "[0, -9.81]") {
  return fmt::format(R"toml(
format = 1
gravity = {}
[simulate]
duration = "0.2 s"
start = "seated"
[ground.markers]
O = [0, 0]
[body.rod]
mass = "2 kg"
inertia = "0.17 kg*m^2"
angle = "{}"
hold = ["angle"]
markers.O = ["-0.5 m", 0]
[joint.O]
type = "revolute"
between = ["ground.O", "rod.O"]
law = "clearance"
clearance = "0.1 mm"
contact_model = "linear"
contact_stiffness = 1e7
)toml", gravity, angle);
}

// It starts at the lowest point of the bush, as deep as the weight presses it, and stays there.
TEST(SeatedStart, ARodAtRestHangsInItsBush) {
  const Trajectory run = completed(parse_model(rod("-90 deg"), "rod.toml"));
  EXPECT_NEAR(value(run, 0, "body.rod.y"), -0.5 - 1e-4 - 2 * 9.81 / 1e7, 1e-11);
  for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(value(run, i, "joint.O.on_rod.fy[world]"), 2 * 9.81, 1e-6 * 2 * 9.81) << i;
}

// After release the rod turns about its pin: along itself the pin carries m g cos(30 deg), across it m g sin(30 deg) less the mass times the acceleration of
// its middle. Theory of the compound pendulum without the pin's motion round its bush, a ten-thousandth of the length.
TEST(SeatedStart, ARodThatIsLetGoBeginsWithThePinForceOfAPendulum) {
  const Trajectory run = completed(parse_model(rod("-60 deg"), "rod.toml"));
  const double weight = 2 * 9.81, along = weight * std::cos(kTurn / 12), across = weight * std::sin(kTurn / 12) * (1 - 2 * 0.25 / (0.17 + 2 * 0.25));
  const double fx = value(run, 0, "joint.O.on_rod.fx[world]"), fy = value(run, 0, "joint.O.on_rod.fy[world]");
  EXPECT_NEAR(std::hypot(fx, fy), std::hypot(along, across), 1e-3 * weight);
  EXPECT_LT(run.joints[0].peak, 1.1 * weight * (1 + 3 * (1 - std::cos(kTurn / 12))));  // and the pin does not strike
}

// The first row has the forces of the same mechanism with ideal pins, and no impact exceeds the forces of its motion.
TEST(SeatedStart, AFourBarWithALoosePinBeginsWithTheForcesOfTheTightOne) {
  const Trajectory loose = completed(mechanism("four_bar_clearance", {kSeated}));
  const Trajectory tight = completed(mechanism("four_bar_clearance", {"--law joint.B=linear"}));
  for (const char* column : {"joint.B.on_follower.fx[world]", "joint.B.on_follower.fy[world]", "joint.A.on_crank.fx[world]", "joint.O4.on_ground.fy[world]"})
    EXPECT_NEAR(value(loose, 0, column), value(tight, 0, column), 0.02 * tight.joints[2].peak) << column;
  EXPECT_TRUE(loose.events.empty());  // the pin stays on its bush
  EXPECT_LT(loose.joints[2].peak, 1.1 * tight.joints[2].peak);
}

TEST(SeatedStart, WhereThePinIsInTheMiddleInsteadItsFirstImpactIsTheLargestForce) {
  const Trajectory centred = completed(mechanism("four_bar_clearance", {"simulate.start=\"assembled\""}));
  EXPECT_TRUE(notes_have(centred, "joints start in the middle of their play (B)"));
  EXPECT_GT(centred.joints[2].peak, 3 * completed(mechanism("four_bar_clearance", {kSeated})).joints[2].peak);
}

// A slide with play on both sides of its guideway, and several loose pins at once.
TEST(SeatedStart, PlayOfSlidesAndOfSeveralPinsIsTakenUp) {
  const Trajectory slide = completed(mechanism("loose_piston", {kSeated}));
  EXPECT_FALSE(notes_have(slide, "middle of their play"));
  const Trajectory pins = completed(mechanism("worn_linkage")), centred = completed(mechanism("worn_linkage", {"simulate.start=\"assembled\""}));
  for (std::size_t j = 0; j < pins.joints.size(); ++j) EXPECT_LT(pins.joints[j].peak, 0.5 * centred.joints[j].peak) << pins.joints[j].name;
}

// A pin that rubs requires a moment of a worn guide: one end lies on each wall. When it was sought on one wall, the bar began 1.2 mm away from its guide, with 83 kN.
TEST(SeatedStart, AWornGuideTiltsUnderTheMomentOfAPinThatRubs) {
  for (const char* friction : {"lugre", "coulomb"}) {
    const Trajectory loose = completed(reference::test_model("needle_bar", {std::string("joint.B.friction=") + friction}));
    const Trajectory tight = completed(reference::test_model("needle_bar", {std::string("joint.B.friction=") + friction, "--law joint.guide=linear"}));
    for (const char* column : {"joint.B.on_bar.fx[world]", "joint.B.on_bar.fy[world]"}) EXPECT_NEAR(value(loose, 0, column), value(tight, 0, column), 0.02 * tight.joints[2].peak) << column;
    EXPECT_LT(loose.energy.potential_start, 0);
    EXPECT_LT(loose.joints[2].peak, 2 * tight.joints[2].peak) << friction;
  }
}

// Joints that follow their loads slowly begin with the forces that carry these loads, although no motion without a transient is found.
TEST(SeatedStart, WornPinsThatRubBeginWithTheForcesOfTightOnes) {
  const std::vector<std::string> brief{"simulate.duration=0.01"};
  const Trajectory loose = completed(reference::test_model("loom_slay", brief));
  const Trajectory tight = completed(reference::test_model("loom_slay", {"simulate.duration=0.01", "--law joint.A=linear", "--law joint.B=linear", "--law joint.P=linear"}));
  for (std::size_t j = 0; j < loose.joints.size(); ++j) {
    const std::string column = "joint." + loose.joints[j].name + ".on_" + loose.joints[j].second_body;
    for (const char* axis : {".fx[world]", ".fy[world]"}) EXPECT_NEAR(value(loose, 0, column + axis), value(tight, 0, column + axis), 0.05 * tight.joints[3].peak) << column << axis;
  }
}

TEST(SeatedStart, AJointThatCarriesNothingStaysInTheMiddle) {
  const Trajectory run = completed(parse_model(rod("0 deg", "[0, 0]"), "rod.toml"));
  EXPECT_TRUE(notes_have(run, "joints that carry no load at the start stay in the middle of their play: O"));
  EXPECT_EQ(run.joints[0].peak, 0);
}

// The smaller the clearance, the nearer to the tight pin: in speeds, and in the largest force.
TEST(SeatedStart, ALittlePlayIsAlmostNone) {
  const Trajectory tight = completed(mechanism("slider_crank_clearance", {"--law joint.B=linear"}));
  double last = 1e300;
  for (const char* play : {"0.5 mm", "0.1 mm", "20 um"}) {
    const Trajectory run = completed(mechanism("slider_crank_clearance", {kSeated, std::string("joint.B.clearance=\"") + play + "\""}));
    const double apart = std::abs(value(run, 0, "body.rod.spin") - value(tight, 0, "body.rod.spin"));
    EXPECT_LT(apart, 0.3 * last) << play;
    last = apart;
  }
  EXPECT_LT(last, 0.05);
}

// A beam of 20 kg and 100 N on two pins 0.15 mm farther apart than its bushes: each leans against the outer side of its bush, 0.075 mm off and as low as a
// circle of 0.1 mm allows. By hand: the pins carry 128.1 and 168.1 N upwards, and the sideways force that follows from the lean.
TEST(SeatedStart, PlayTakesUpAMisfit) {
  const Trajectory run = completed(reference::test_model("beam_on_loose_pins", {"ground.markers.R=[\"1000.15 mm\", 0]"}));
  EXPECT_NEAR(value(run, 0, "joint.L.on_beam.fy[world]"), 128.07, 3);
  EXPECT_NEAR(value(run, 0, "joint.R.on_beam.fy[world]"), 168.07, 3);
  EXPECT_NEAR(value(run, 0, "joint.L.on_beam.fx[world]"), -162.7, 3);
  EXPECT_LT(run.joints[1].peak, 1.05 * 234.3);
  EXPECT_FALSE(notes_have(run, "misfit"));
}

TEST(SeatedStart, RelativeCoordinatesStartInTheSameWay) {
  const Trajectory free = completed(parse_model(rod("-60 deg"), "rod.toml")), tree = completed(parse_model(rod("-60 deg"), "rod.toml", {"simulate.equations=\"relative\""}));
  EXPECT_NEAR(value(tree, 0, "joint.O.on_rod.fy[world]"), value(free, 0, "joint.O.on_rod.fy[world]"), 1e-6 * 19.62);
}

// Without play it is the assembled start, to the last bit.
TEST(SeatedStart, AMechanismWithoutPlayIsAssembled) {
  const Trajectory seated = completed(mechanism("four_bar", {kSeated})), assembled = completed(mechanism("four_bar"));
  EXPECT_EQ(value(seated, 10, "joint.A.on_crank.fx[world]"), value(assembled, 10, "joint.A.on_crank.fx[world]"));
}

// A shaft that turns in a dry bush starts where load and friction balance, atan(mu) up the bush, whatever the duration of the run.
TEST(SeatedStart, AShaftClimbsItsBushForAnyDuration) {
  for (const double duration : {0.02, 0.1, 0.5, 2.0}) {
    const Trajectory run = completed(reference::shaft_in_bush(0.25, 30, "speed = 30", duration));
    EXPECT_NEAR(value(run, 0, "joint.J.on_shaft.fy[world]"), 400, 0.01) << duration;
    EXPECT_NEAR(value(run, 0, "joint.J.on_shaft.m[world]"), -400 / std::sqrt(1 + 0.25 * 0.25) * 0.25 * 0.012, 1e-4) << duration;
    EXPECT_NEAR(run.joints[0].peak, 400, 0.05) << duration;
  }
}

// The pin of the second of three parallel cranks cannot move to its side along the cranks: it would strain the others by thousands of newtons.
TEST(SeatedStart, APinThatOtherCranksHoldInTheMiddleIsLeftOpen) {
  const Trajectory run = completed(reference::test_model("coupling_rod_on_three_cranks", {"simulate.duration=0.01"}));
  EXPECT_LT(run.joints[2].peak, 100) << run.joints[2].name;
  EXPECT_TRUE(notes_have(run, "stay in the middle of their play: B"));
}

// A pin that slides in its bush from the first instant does not know of its static friction: equal coefficients give the forces without stiction, and a first row
// without a blow.
TEST(SeatedStart, APinThatSlidesBeginsWithoutTheFrictionOfAStuckOne) {
  const std::string equal = "joint.B.friction_coefficient=0.15";
  Model sliding = reference::test_model("four_bar_seated_stiction", {equal});
  sliding.simulate.duration = 0.01;
  const Trajectory with = completed(sliding);
  for (const LoadSummary& joint : with.joints) EXPECT_LT(joint.peak, 400) << joint.name;
  std::string text = read_file(std::string(PINTLE_SOURCE_DIR) + "/tests/models/four_bar_seated_stiction.toml");
  text.erase(text.find("static_friction"), std::string("static_friction = 0.15\n").size());
  const Trajectory without = completed(parse_model(text, "four_bar.toml", {equal, "simulate.duration=0.01"}));
  for (std::size_t j = 0; j < with.joints.size(); ++j) EXPECT_NEAR(with.joints[j].peak, without.joints[j].peak, 0.02 * without.joints[j].peak) << with.joints[j].name;
}

// On its way to its side a pin moves what other joints share: the object between the jaws, whose spring may carry the finger before the pin is pressed. The pin was driven
// 44 um into its bush, with 35 kN.
TEST(SeatedStart, APinThatMovesASoftObjectIsNotDrivenIntoItsBush) {
  const auto gripper = [](const std::string& stiffness) { return completed(reference::test_model("gripper_with_loose_pin", {"joint.object.stiffness=" + stiffness, "simulate.tolerance=1e-4"})); };
  EXPECT_NEAR(value(gripper("200"), 0, "joint.E1.contact_force"), 2.0, 0.1);  // its load is 2.3 N with a tight pin and no object
  EXPECT_LT(value(gripper("2e3"), 0, "joint.E1.contact_force"), 20);
  const Trajectory firm = gripper("2e4");
  EXPECT_EQ(value(firm, 0, "joint.E1.contact_force"), 0);  // the object carries the finger
  EXPECT_NEAR(firm.joints[2].peak, 1882.6, 2);              // where the jaws are closed farthest, at 0.42 s
}

}  // namespace
}  // namespace pintle
