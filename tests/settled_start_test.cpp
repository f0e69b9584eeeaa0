// start = "settled": mechanisms that begin in static equilibrium, with contacts, clearances, friction and motors; bodies that have none are named.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/constants.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::value;

// A lever of 4 kg on a pin, with its tip of 10 mm on a table: each carries half of its weight.
std::string lever(const std::string& of_pin, const std::string& start) {
  return fmt::format(R"toml(
format = 1
[simulate]
duration = "0.2 s"
start = "{}"
[ground.markers]
O = [0, 0]
table = ["0.5 m", "-10 mm"]
[body.lever]
mass = "4 kg"
inertia = "0.08 kg*m^2"
position = ["0.25 m", 0]
angle = 0
markers.O = ["-0.25 m", 0]
markers.tip = ["0.25 m", 0]
[joint.O]
type = "revolute"
between = ["ground.O", "lever.O"]
{}
[joint.rest]
type = "slot"
between = ["ground.table", "lever.tip"]
law = "contact"
pin_radius = "10 mm"
)toml",
                     start, of_pin);
}

Trajectory run_of(const std::string& text) { return completed(parse_model(text, "settled.toml")); }

// Loads that are small compared with the springs that carry them: the fluid of the first attempt is so thin that the body swings.
TEST(SettledStart, SpringsStretchByWhatLoadsAsk) {
  const auto loaded = [](double torsion, double torque, double stiffness, double force) {
    return run_of(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "10 ms"
start = "settled"
[ground.markers]
O = [0, 0]
wall = ["-1 m", 0]
[body.arm]
mass = "2 kg"
inertia = "0.02 kg*m^2"
markers.c = [0, 0]
[body.slide]
mass = "1 kg"
inertia = "0.01 kg*m^2"
markers.c = [0, 0]
[joint.pin]
type = "revolute"
between = ["ground.O", "arm.c"]
[joint.guide]
type = "prismatic"
between = ["ground.O", "slide.c"]
[torsion_spring.k]
between = ["ground.O", "arm.c"]
stiffness = {}
free_angle = 0
[spring.s]
between = ["ground.wall", "slide.c"]
stiffness = {}
free_length = "1 m"
[force.turn]
on = "arm.c"
torque = {}
[force.push]
on = "slide.c"
force = [{}, 0]
)toml",
                              torsion, stiffness, torque, force));
  };
  for (const auto& [torsion, torque, stiffness, force] : {std::array{0.43, 1e-4, 1e3, 0.01}, std::array{50.0, 1e-2, 1e5, 1.0}, std::array{1e-3, 1e-6, 1.0, 0.1}}) {
    const Trajectory run = loaded(torsion, torque, stiffness, force);
    for (const std::size_t row : {std::size_t{0}, run.n_rows() - 1}) {
      EXPECT_NEAR(value(run, row, "body.arm.angle"), torque / torsion, 1e-6 * torque / torsion) << torsion;
      EXPECT_NEAR(value(run, row, "body.slide.x"), force / stiffness, 1e-6 * force / stiffness) << stiffness;
    }
  }
}

TEST(SettledStart, ALeverOnItsRestCarriesHalfItsWeightInEachSupportAllTheTime) {
  const double half = 2 * kStandardGravity;
  for (const char* start : {"assembled", "settled"}) {
    const Trajectory run = run_of(lever("", start));
    for (const LoadSummary& joint : run.joints) {
      EXPECT_NEAR(joint.peak, half, 1e-5 * half) << joint.name << start;
      EXPECT_NEAR(joint.rms, half, 1e-5 * half) << joint.name << start;
    }
    EXPECT_LT(run.energy.kinetic_peak, 1e-12) << start;
  }
}

TEST(SettledStart, APinRestsAtTheBottomOfItsClearance) {
  const double half = 2 * kStandardGravity;
  const Trajectory run = run_of(lever("law = \"clearance\"\nclearance = \"50 um\"\npin_radius = \"10 mm\"\ncontact_stiffness = 1e9\nrestitution = 0.7", "settled"));
  EXPECT_NEAR(run.joints[0].peak, half, 1e-4 * half);
  EXPECT_NEAR(value(run, 0, "body.lever.y"), -0.5 * (50e-6 + std::pow(half / 1e9, 2.0 / 3.0)), 1e-6);
  EXPECT_LT(run.energy.kinetic_peak, 1e-10);
}

// A block on a slope of 10 degrees, which friction holds up to 19.
TEST(SettledStart, WhatFrictionHoldsStays) {
  const Trajectory run = run_of(R"toml(
format = 1
[simulate]
duration = "0.5 s"
start = "settled"
[ground.markers]
rail = [0, 0, "-10 deg"]
[body.block]
mass = "3 kg"
inertia = "0.01 kg*m^2"
position = [0, 0]
angle = "-10 deg"
markers.c = [0, 0]
[joint.rail]
type = "prismatic"
between = ["ground.rail", "block.c"]
friction = "coulomb"
friction_coefficient = 0.3
)toml");
  EXPECT_NEAR(value(run, 0, "joint.rail.friction"), -3 * kStandardGravity * std::sin(kPi / 18), 1e-5);
  EXPECT_EQ(value(run, 0, "joint.rail.stuck"), 1);
  EXPECT_NEAR(value(run, 0, "body.block.x"), 0, 1e-6);
  EXPECT_LT(run.energy.kinetic_peak, 1e-12);
}

TEST(SettledStart, APendulumHangsUnlessItIsHeld) {
  Model model = reference::mechanism("pendulum");
  for (Body& body : model.bodies) {
    body.velocity.reset();
    body.spin.reset();
    body.hold = {};
  }
  model.simulate.start = Start::kSettled;
  const Trajectory hanging = completed(model);
  EXPECT_LT(hanging.energy.kinetic_peak, 1e-9);
  model.bodies[0].hold[2] = true;
  const Trajectory held = completed(model);
  EXPECT_NEAR(value(held, 0, "body." + model.bodies[0].name + ".angle"), *model.bodies[0].angle, 1e-5);
  EXPECT_GT(held.energy.kinetic_peak, 1e-2);
  EXPECT_TRUE(std::any_of(held.notes.begin(), held.notes.end(), [](const std::string& note) { return note.find("not in equilibrium") != std::string::npos; }));
}

// A crank under `hold` whose servo carries 5 kg at 0.4 m: a spring in parallel with the servo would drop its share when the run begins.
TEST(SettledStart, AServoCarriesWhatItMoves) {
  const Trajectory run = run_of(R"toml(
format = 1
[simulate]
duration = "0.2 s"
start = "settled"
[ground.markers]
O = [0, 0]
wall = ["-1 m", 0]
[body.arm]
mass = "5 kg"
inertia = "0.05 kg*m^2"
position = ["0.4 m", 0]
angle = 0
hold = ["angle"]
markers.O = ["-0.4 m", 0]
[joint.O]
type = "revolute"
between = ["ground.O", "arm.O"]
[motor.drive]
joint = "O"
position = 0
)toml");
  EXPECT_NEAR(run.joints[0].peak, 5 * kStandardGravity, 1e-5 * 5 * kStandardGravity);
  EXPECT_LT(run.energy.kinetic_peak, 1e-12);
}

// The load at t = 0 counts, not a later one.
TEST(SettledStart, LoadsStandStill) {
  const Trajectory run = run_of(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "1 s"
start = "settled"
[ground.markers]
wall = [0, 0]
[body.block]
mass = "2 kg"
inertia = "0.01 kg*m^2"
position = ["0.5 m", 0]
angle = 0
markers.c = [0, 0]
[joint.rail]
type = "prismatic"
between = ["ground.wall", "block.c"]
[spring.s]
between = ["ground.wall", "block.c"]
stiffness = "200 N/m"
free_length = "0.4 m"
[force.push]
on = "block.c"
force = ["10 N*cos(3 rad/s*t)", 0]
)toml");
  EXPECT_NEAR(value(run, 0, "body.block.x"), 0.45, 1e-9);
  EXPECT_NEAR(value(run, 0, "spring.s.force"), 10, 1e-6);
  EXPECT_GT(run.energy.kinetic_peak, 1e-3);
}

TEST(SettledStart, WhatNothingHoldsIsNamed) {
  const Model model = parse_model(R"toml(
format = 1
[simulate]
duration = "1 s"
start = "settled"
[body.stone]
mass = "2 kg"
inertia = "0.01 kg*m^2"
position = [0, 0]
angle = 0
)toml",
                                  "settled.toml");
  try {
    simulate(model);
    ADD_FAILURE() << "a falling stone has settled";
  } catch (const AssemblyError& error) {
    EXPECT_NE(std::string(error.what()).find("body stone does not come to rest"), std::string::npos) << error.what();
  }
}

// A lever whose spring is shortest in line with its pin: when disturbed, the lever leaves that position for one of two where the spring is unstretched,
// acos(3/4) to either side. No force acts there.
TEST(SettledStart, AnEquilibriumThatIsNotStableIsLeft) {
  for (const char* angle : {"0", "1 deg"}) {
    const Trajectory run = run_of(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "2 s"
start = "settled"
[ground.markers]
O = [0, 0]
S = ["0.3 m", 0]
[body.lever]
mass = "1 kg"
inertia = "0.005 kg*m^2"
angle = "{}"
markers.O = ["-0.1 m", 0]
markers.S = ["0.1 m", 0]
[joint.O]
type = "revolute"
between = ["ground.O", "lever.O"]
[spring.S]
between = ["ground.S", "lever.S"]
stiffness = "1000 N/m"
damping = "5 N*s/m"
free_length = "0.2 m"
)toml",
                                              angle));
    EXPECT_NEAR(std::abs(value(run, 0, "body.lever.angle")), std::acos(0.75), 1e-6) << angle;
    EXPECT_LT(run.joints[0].peak, 1e-7) << angle;
    EXPECT_LT(run.counters.steps, 1000u) << "of rounding: " << angle;
    const bool left = std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("is unstable") != std::string::npos; });
    EXPECT_EQ(left, *angle == '0');
  }
}

// The tensions of the ropes by hand: from the moments of both weights about the foot, and from the load's weight.
TEST(SettledStart, ACraneHangsInItsRopes) {
  const Trajectory run = completed(reference::test_model("luffing_crane", {"simulate.duration=0.5 s"}));
  constexpr double kGravity = 9.81;  // the file's
  const double load = 1500 * kGravity;
  EXPECT_NEAR(-value(run, 0, "joint.hoist.force"), load, 1e-6 * load);
  const double angle = value(run, 0, "body.boom.angle"), tip_x = 6 * std::cos(angle), tip_y = 6 * std::sin(angle), rope = std::hypot(tip_x, tip_y - 4);
  const double arm = 4 * tip_x / rope;  // of the luffing rope about the foot
  EXPECT_NEAR(-value(run, 0, "joint.luff.force"), (load * tip_x + 800 * kGravity * 0.5 * tip_x) / arm, 0.005 * load);
  for (const LoadSummary& joint : run.joints) EXPECT_LT(joint.peak, 1.001 * joint.rms) << joint.name;
}

// A brake holds what was held while the drum came to rest. On the way there its springs had been bent, and they were as likely to push the load on.
TEST(SettledStart, StictionTakesOverWhatWasHeld) {
  for (const char* friction : {"coulomb", "lugre"})
    for (const double torque : {100.0, 1000.0, -3000.0}) {
      const Trajectory run = completed(reference::test_model("braked_drum", {"force.load.torque=" + std::to_string(torque), "joint.axle.friction=" + std::string(friction)}));
      EXPECT_NEAR(value(run, 0, "joint.axle.friction"), -torque, 1e-3 * std::abs(torque)) << friction << ", " << torque;
      EXPECT_NEAR(value(run, run.n_rows() - 1, "joint.axle.friction"), -torque, 1e-3 * std::abs(torque)) << friction << ", " << torque;
      EXPECT_NEAR(reference::at_end(run, "body.drum.angle"), value(run, 0, "body.drum.angle"), 1e-5) << friction << ", " << torque;
    }
}

// Where nothing moves, the roundoff of a speed puts it on either side of a kink in every step: 111,000 steps were rejected.
TEST(SettledStart, ARamThatRestsTakesFewSteps) {
  const Trajectory run = completed(reference::test_model("ram_on_its_stop"));
  EXPECT_LT(run.counters.steps + run.counters.rejected, 2000u);
  EXPECT_LT(run.counters.events, 100u);
}

// While it creeps it rubs with its kinetic friction, which does not hold it; where it was assembled its static friction does.
TEST(SettledStart, ABlockThatOnlyStictionHoldsStartsWhereItIs) {
  const Trajectory run = completed(reference::test_model("block_held_by_stiction"));
  EXPECT_NEAR(value(run, run.n_rows() - 1, "body.b.x"), value(run, 0, "body.b.x"), 1e-9);
  EXPECT_NEAR(std::abs(value(run, 0, "joint.j.friction")), 2 * 9.80665 * std::sin(20 * std::acos(-1) / 180), 1e-6);
}

// Pins that fall through their clearance and stick in their bushes on the way.
TEST(SettledStart, LoosePinsThatStickComeToRest) {
  for (const char* angle : {"75 deg", "105 deg", "125 deg"}) {
    const Model model = reference::test_model("sofa_back_on_loose_pins", {fmt::format("body.rear.angle=\"{}\"", angle), "simulate.duration=\"20 ms\""});
    const Trajectory run = completed(model);
    for (const LoadSummary& joint : run.joints) EXPECT_LT(joint.relative_error_estimate, model.simulate.tolerance) << joint.name;
    double carried = 0;  // by the pins, from the first instant on
    for (const char* column : {"joint.A.on_rear.fy[world]", "joint.D.on_front.fy[world]"}) carried += value(run, 0, column);
    EXPECT_GT(std::abs(carried), 1) << angle;
  }
}

// It sinks far and steadily in a fluid so thick that its post no longer swings.
TEST(SettledStart, ARiderSinksIntoTheElastomerOfALoosePost) {
  const Trajectory run = completed(reference::test_model("seat_post_with_play"));
  EXPECT_NEAR(value(run, 0, "joint.rail.on_frame.fy[world]"), 80.7 * 9.80665, 1e-3);
  EXPECT_NEAR(run.joints[0].peak, 80.7 * 9.80665, 1e-2);
}

// The tube's play is used up, and friction with stiction holds it where it has come to rest.
TEST(SettledStart, APostThatRubsOnItsWayComesToRest) {
  const Trajectory run = completed(reference::test_model("seat_post_with_play", {"joint.tube.friction_coefficient=0.15", "joint.tube.static_friction=0.18", "joint.tube.stick_stiffness=1e7", "joint.tube.stick_damping=1e4"}));
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("settled: the mechanism came to rest") != std::string::npos; }));
  EXPECT_NEAR(run.joints[0].peak, 80.7 * 9.80665, 1e-2);
}

}  // namespace
}  // namespace pintle
