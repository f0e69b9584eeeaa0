// Ideal joints with multipliers, against closed forms and one-coordinate solutions; messages about redundant constraints and singular positions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/constants.h"
#include "pintle/read_model.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::value;

constexpr double kNineDigits = 1e-9;

Trajectory ideal_run(const std::string& mechanism, std::vector<std::string> overrides = {}) {
  overrides.push_back("simulate.equations=\"ideal\"");
  const Trajectory run = simulate(reference::mechanism(mechanism, overrides));
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_EQ(run.method, "dopri5");
  return run;
}

bool mentions(const Trajectory& run, const std::string& what) {
  for (const std::string& note : run.notes)
    if (note.find(what) != std::string::npos) return true;
  return false;
}

// The two rows of its pin are nearly dependent wherever the arm lies between the pin's axes, which is no singular position: at 1e-4 kg m^2 forces of 1000 N were
// stated, and at 1e-7 the run did not end.
TEST(Ideal, ThePinOfAPointMassHasNoSingularPosition) {
  for (const char* inertia : {"1e-3", "1e-4", "1e-7", "1e-10"}) {
    const Trajectory run = completed(reference::test_model("point_mass", {"simulate.equations=\"ideal\"", std::string("body.bob.inertia=") + inertia}));
    const double spread = 1 / (1 + std::atof(inertia) / 2);
    EXPECT_NEAR(run.joints.at(0).peak, 2 * kStandardGravity * (1 + 2 * (1 - std::cos(1.0)) * spread), 1e-5) << inertia;
    EXPECT_LT(run.counters.steps, 1000u) << inertia;
  }
}

struct Pin {
  const char *column, *x, *y;
};

void expect_pins(const Trajectory& run, const reference::Table& exact, std::initializer_list<Pin> pins) {
  for (const Pin& pin : pins)
    for (std::size_t i = 0; i < exact.rows.size(); ++i) {
      const std::size_t row = reference::row_at(run, exact.at(i, "t"));
      EXPECT_LT(reference::force_error(run, row, pin.column, exact.at(i, pin.x), exact.at(i, pin.y)), kNineDigits * exact.peak(pin.x, pin.y))
          << pin.column << " " << i;
    }
}

// Rubber is there to yield: m w^2 of the shaken mass, of which a rigid mount would carry all.
TEST(Ideal, LeavesRubberAlone) {
  const Trajectory yields = simulate(reference::test_model("mass_on_a_rubber_mount"));
  ASSERT_EQ(yields.outcome, Outcome::kCompleted) << yields.message;
  for (const char* equations : {"ideal", "penalty", "augmented_lagrangian", "relative_augmented_lagrangian"}) {
    const Trajectory run = simulate(reference::test_model("mass_on_a_rubber_mount", {std::string("simulate.equations=\"") + equations + "\""}));
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << equations << run.message;
    EXPECT_NEAR(run.joints[0].peak, yields.joints[0].peak, 1e-4 * yields.joints[0].peak) << equations;
  }
}

TEST(Ideal, FourBarHasNineDigits) {
  const Trajectory run = ideal_run("four_bar", {"simulate.tolerance=1e-9"});
  const reference::Table exact = reference::read_table("four_bar");
  expect_pins(run, exact, {{"O2.on_crank", "F12x", "F12y"}, {"A.on_coupler", "F23x", "F23y"}, {"B.on_follower", "F34x", "F34y"}, {"O4.on_follower", "F14x", "F14y"}});
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.follower.angle"), exact.at(i, "theta4"), kNineDigits);
    EXPECT_NEAR(value(run, row, "body.follower.spin"), exact.at(i, "omega4"), 10 * kNineDigits);
  }
  EXPECT_LT(run.energy.drift, 1e-11 * run.energy.kinetic_peak);
}

TEST(Ideal, InvertedSliderCrankHasNineDigits) {
  const Trajectory run = ideal_run("inverted_slider_crank", {"simulate.tolerance=1e-9", "simulate.duration=pi/10"});
  const reference::Table exact = reference::read_table("inverted_slider_crank");
  reference::Table turn = exact;
  turn.rows.resize(37);
  expect_pins(run, turn, {{"O2.on_crank", "F12x", "F12y"}, {"A.on_block", "F23x", "F23y"}, {"O4.on_guide", "F14x", "F14y"}});
  for (std::size_t i = 0; i < turn.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, turn.at(i, "t"));
    EXPECT_NEAR(value(run, row, "joint.P.on_block.f2[joint]"), turn.at(i, "N43"), kNineDigits * turn.peak("N43"));
    EXPECT_NEAR(value(run, row, "joint.P.on_block.m[world]"), turn.at(i, "M43"), kNineDigits * turn.peak("M43"));
  }
}

TEST(Ideal, PendulumIsTheEllipticFunction) {
  const Trajectory run = ideal_run("pendulum", {"simulate.tolerance=1e-9"});
  const reference::Table exact = reference::read_table("pendulum");
  expect_pins(run, exact, {{"pin.on_rod", "Fx", "Fy"}});
  for (std::size_t i = 0; i < exact.rows.size(); ++i)
    EXPECT_NEAR(value(run, reference::row_at(run, exact.at(i, "t")), "body.rod.angle"), exact.at(i, "theta"), kNineDigits);
}

// Compliant joints of 1e10 N/m give the forces of ideal ones to six digits.
TEST(Ideal, StiffJointsTendToIt) {
  const Trajectory ideal = ideal_run("four_bar", {"simulate.tolerance=1e-8"});
  Model model = reference::mechanism("four_bar", {"simulate.tolerance=1e-7"});
  reference::set_joints(model, 1e10, 3e4);
  const Trajectory stiff = simulate(model);
  ASSERT_EQ(stiff.n_rows(), ideal.n_rows());
  for (const LoadSummary& joint : ideal.joints) {
    const std::string column = joint.name + ".on_" + joint.second_body, path = "joint." + column;
    for (std::size_t row = 0; row < ideal.n_rows(); ++row)
      EXPECT_LT(reference::force_error(stiff, row, column, value(ideal, row, path + ".fx[world]"), value(ideal, row, path + ".fy[world]")), 1e-6 * joint.peak);
  }
}

// Two four-bars in a row pass through positions where all bars are in line; the exact motion passes straight through.
TEST(Ideal, GoesThroughSingularPositionsAndNamesThem) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_2", {"simulate.equations=\"ideal\"", "simulate.duration=4"}));
  EXPECT_EQ(run.outcome, Outcome::kToleranceNotMet);  // the weight of the bars pushes them across the branch
  EXPECT_NE(run.message.find("have no bound at the singular position near t = "), std::string::npos) << run.message;
  const reference::Table exact = reference::read_table("n_four_bar_2");
  for (std::size_t i = 0; i < exact.rows.size() && exact.at(i, "t") <= 4; ++i) {
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.crank0.angle"), exact.at(i, "theta"), 1e-6) << exact.at(i, "t");
    EXPECT_NEAR(value(run, row, "body.crank2.angle"), exact.at(i, "theta"), 1e-6) << exact.at(i, "t");
  }
  // All bars are horizontal after a quarter of a turn: by the energy of cranks and couplers, spin^2 = 1 + 2 g S/J (1 - sin angle).
  const double fall = 2 * 9.81 * 3.5 / 3, quarter = std::numbers::pi / 2;
  double t = 0;
  const int n = 2000;
  for (int i = 0; i <= n; ++i)
    t += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * quarter / (3 * n) / std::sqrt(1 + fall * (1 - std::sin(quarter * i / n)));
  int named = 0;
  for (const std::string& note : run.notes) {
    const auto at = note.find("singular position at t = ");
    if (at == std::string::npos) continue;
    if (named++ == 0) {
      EXPECT_NEAR(std::stod(note.substr(at + 25)), t, 1e-5);
    }
    EXPECT_NE(note.find(" along x"), std::string::npos) << note;  // the bars' own direction
  }
  EXPECT_GE(named, 3);
  // Roundoff on the way through a singular position decides the drift: measured 7e-10 to 3e-8.
  EXPECT_LT(run.energy.drift, 1e-7 * run.energy.kinetic_peak);
}

TEST(Ideal, NamesRedundantJointsAndStillMoves) {
  const Trajectory run = ideal_run("five_bar_parallelogram", {"simulate.duration=0.3"});
  EXPECT_TRUE(mentions(run, "1 redundant constraint"));
  for (const LoadSummary& joint : run.joints) EXPECT_FALSE(joint.unique) << joint.name;
  const std::size_t last = run.n_rows() - 1;
  const double turned = 2 * std::numbers::pi * 0.3;
  for (const char* crank : {"crank1", "crank2", "crank3"})
    EXPECT_NEAR(value(run, last, std::string("body.") + crank + ".angle") - value(run, 0, std::string("body.") + crank + ".angle"), turned, 2e-4) << crank;
}

TEST(Ideal, UniqueReactionsAreCalledUnique) {
  for (const LoadSummary& joint : ideal_run("four_bar").joints) EXPECT_TRUE(joint.unique) << joint.name;
}

// Inconsistent velocities are made consistent by an impulse in the joints, which takes kinetic energy.
TEST(Ideal, InconsistentVelocitiesAreAnImpulse) {
  const Trajectory run = ideal_run("four_bar", {"simulate.start=\"raw\""});
  EXPECT_TRUE(mentions(run, "an impulse"));
  EXPECT_EQ(run.outcome, Outcome::kCompleted);
}

// A block in a guide, pushed by a force that jumps where its speed changes sign.
Trajectory push(const std::string& force, const std::string& speed) {
  const Trajectory run = simulate(parse_model(R"toml(format = 1
gravity = [0, 0]
[simulate]
duration = 1
equations = "ideal"
[ground.markers]
O = [0, 0]
[body.block]
mass = 1
inertia = 0.1
position = [0, 0]
angle = 0
velocity = [)toml" + speed + R"toml(, 0]
markers.C = [0, 0]
[joint.guide]
type = "prismatic"
between = ["ground.O", "block.C"]
[motor.push]
joint = "guide"
force = ")toml" + force + "\"\n", "push.toml"));
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  return run;
}

TEST(Ideal, GoesOverJumpsOfAForce) {
  const Trajectory back = push("if(rate > 0, -2, -1)", "1");  // stops at 0.5 s after 0.25 m, and comes back with half the force
  EXPECT_NEAR(value(back, back.n_rows() - 1, "body.block.x"), 0.25 - 0.5 * 0.25, 1e-6);
  EXPECT_NEAR(value(back, back.n_rows() - 1, "body.block.vx"), -0.5, 1e-6);
  const Trajectory off = push("if(rate > 0, 2, 1)", "0");  // jumps at the start
  EXPECT_NEAR(value(off, off.n_rows() - 1, "body.block.x"), 1, 1e-6);
}

// An arm on a motor; `more` are further keys of its joint, placed last.
Model driven_arm(const std::string& motor, const std::string& equations, const std::string& spin = "0", const std::string& more = "", const std::string& duration = "1 s") {
  return parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "{}"
equations = "{}"
[ground.markers]
O = [0, 0]
[body.a]
mass = 1
inertia = 0.1
angle = 0
spin = "{}"
markers.O = ["-0.2 m", 0]
markers.T = ["0.2 m", 0]
[motor.m]
joint = "O"
{}
[joint.O]
type = "revolute"
between = ["ground.O", "a.O"]
{}
)toml", duration, equations, spin, motor, more), "driven_arm.toml");
}

// An acceleration may jump, at the start as well: 24 rad/s^2 at 0.2 m and the weight.
TEST(Ideal, MotorsStartWithAnAcceleration) {
  for (const char* from : {"0 s", "0.1 s"}) {
    const Trajectory run = completed(driven_arm(fmt::format("position = \"smoothstep({}, {} + 0.5 s, t)\"", from, from), "ideal"));
    EXPECT_NEAR(run.joints[0].peak, 0.2 * 24 + 9.80665, 1e-6) << from;
    EXPECT_LT(run.energy.drift, 1e-7);
  }
}

// A speed may not: ideal joints would need an infinite force. Servos tolerate it, and their bodies follow.
TEST(Ideal, AMotorWhoseSpeedJumpsIsNamed) {
  for (const char* motor : {"position = \"if(t < 0.5 s, 1 rad/s*t, 0.5 rad)\"", "speed = \"if(t < 0.5 s, 1 rad/s, 0 rad/s)\"", "speed = \"if(t > 0.5 s, 0 rad/s, 1 rad/s)\""}) {
    const Trajectory failed = simulate(driven_arm(motor, "ideal", "1"));
    EXPECT_EQ(failed.outcome, Outcome::kFailed) << motor;
    EXPECT_NEAR(failed.t_end, 0.5, 1e-9);
    EXPECT_NE(failed.message.find("motor m is to change its speed by -1 rad/s instantly at t = 0.5 s"), std::string::npos) << failed.message;
    for (const char* equations : {"newtonian", "relative"}) {
      const Trajectory run = completed(driven_arm(motor, equations, "1"));
      EXPECT_NEAR(value(run, run.n_rows() - 1, "body.a.angle"), 0.5, 1e-4) << motor << equations;
      EXPECT_NEAR(value(run, run.n_rows() - 1, "body.a.spin"), 0, 1e-5) << motor << equations;
      EXPECT_LT(run.energy.drift, 1e-5) << motor << equations;
    }
  }
  for (const char* before : {"t < 0.5 s", "t <= 0.5 s"}) {
    const Trajectory failed = simulate(driven_arm(fmt::format("position = \"if({}, 0, 0.1)\"", before), "ideal"));
    EXPECT_EQ(failed.outcome, Outcome::kFailed) << before;
    EXPECT_NE(failed.message.find("motor m is to jump by 0.1 rad at t = 0.5 s"), std::string::npos) << failed.message;
  }
  const Trajectory step = completed(driven_arm("position = \"if(t < 0.5 s, 0, 0.1)\"", "newtonian"));
  EXPECT_NEAR(value(step, step.n_rows() - 1, "body.a.angle"), 0.1, 1e-4);
}

// A balanced disc without gravity, whose joint carries nothing: errors were measured relative to almost nothing, and roundoff was rejected.
TEST(Ideal, ADiscThatCarriesNothingIsTurned) {
  const auto turned = [](const std::string& motor) {
    return parse_model(R"toml(
format = 1
gravity = [0, 0]
simulate = { duration = "0.2 s", equations = "ideal" }
ground.markers.O = [0, 0]
body.disc = { mass = 5, inertia = 0.1, angle = 0, hold = ["angle"], markers = { O = [0, 0] } }
joint.O = { type = "revolute", between = ["ground.O", "disc.O"] }
[motor.m]
joint = "O"
)toml" + motor, "disc.toml");
  };
  for (const char* speed : {"1", "20", "100 rpm", "100"}) {
    const Trajectory run = completed(turned(fmt::format("speed = \"{}\"", speed)));
    EXPECT_LT(run.counters.steps, 40u) << speed;
    EXPECT_LT(std::abs(run.motors[0].peak_effort), 1e-9) << speed;
  }
  const Trajectory swung = completed(turned("position = \"sin(100 rad/s*t)\""));
  EXPECT_NEAR(std::abs(swung.motors[0].peak_effort), 0.1 * 1e4, 1e-6);
  EXPECT_LT(swung.counters.steps, 2000u);
  const Trajectory failed = simulate(turned("position = \"atan2(sin(30 rad/s*t), cos(30 rad/s*t))\""));
  EXPECT_NE(failed.message.find("motor m is to jump by -6.283 rad at t = 0.104719755 s"), std::string::npos) << failed.message;
}

// At a kink of its command a motor has the speed after the kink: at the start that of assembly; later, if the kink falls exactly on a floating-point time, the
// next one.
TEST(Ideal, AMotorThatStartsOnAKinkHasTheSpeedBehindIt) {
  for (const char* motor : {"position = \"abs(sin(4*t))\"", "position = \"abs(sin(-4*t))\""}) {
    for (const char* equations : {"ideal", "newtonian", "relative"}) {
      const Trajectory run = completed(driven_arm(motor, equations, "4", "", "0.5 s"));
      EXPECT_NEAR(run.joints[0].peak, std::hypot(0.2 * 16, 9.80665), 0.6) << motor << equations;
      EXPECT_EQ(run.notes.size(), equations == std::string_view("relative") ? 1 : 0) << motor << equations;
    }
  }
  const Trajectory failed = simulate(driven_arm("position = \"abs(1 rad - 2 rad/s*t)\"", "ideal", "-2"));
  EXPECT_NE(failed.message.find("motor m is to change its speed by 4 rad/s instantly at t = 0.5 s"), std::string::npos) << failed.message;
}

// A rotor of 3 mm that has turned by ten turns: the roundoff of its angle is more than that of its size. The force across the slide is that of the unbalance alone,
// m e (w^2 sin - w' cos) of the angle turned, in every row.
TEST(Ideal, TurnsLargerThanTheMechanismAreClosed) {
  Model model = reference::test_model("unbalanced_rotor_run_up");
  model.simulate.equations = Equations::kIdeal;
  model.simulate.duration = 2.25;
  model.simulate.output_step = 1e-3;
  const Trajectory run = completed(model);
  const auto force = static_cast<std::size_t>(run.column("joint.S.on_frame.fx[world]"));
  double largest = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double t = run.at(i, 0), spin = 25 * t, angle = 12.5 * t * t;
    const double unbalance = 10 * 0.003 * (spin * spin * std::sin(angle) - 25 * std::cos(angle));
    largest = std::max(largest, std::abs(run.at(i, force) - unbalance));
  }
  EXPECT_LT(largest, 1e-6);
  EXPECT_LT(run.counters.evaluations, 20000u);
}

// Ideal joints have no steps that slide along a jump: the governor at its speed is named, and where it can be held.
TEST(Ideal, AGovernorAtItsSpeedIsNamed) {
  Model model = reference::test_model("governed_pump");
  model.simulate.equations = Equations::kIdeal;
  const Trajectory run = simulate(model);
  EXPECT_EQ(run.outcome, Outcome::kFailed);
  EXPECT_NE(run.message.find("of motor gov (if(rate < 25 rad/s, 12 N*m, 0)) is crossed again and again. Only equations = \"newtonian\""), std::string::npos) << run.message;
}

// Peak and mean of a force that balances a load without any motion do not depend on the steps of the motion: the pin of an arm that a motor holds.
TEST(Ideal, PeaksFollowLoadsWithinAStep) {
  struct Case {
    const char* load;
    double peak, rms;
  };
  const double bell = 0.01 * std::sqrt(std::acos(-1.0) / 2);  // of exp(-2 x^2)
  for (const Case& at : {Case{"1 N*sin(20 rad/s*t)", 1, std::sqrt(0.5 - std::sin(40.0) / 80)}, Case{"1 N*if(t < 0.5 s, (t/(0.5 s))^2, 0)", 1, std::sqrt(0.1)},
                         Case{"100 N*exp(-((t - 0.37 s)/(0.01 s))^2)", 100, 100 * std::sqrt(bell)}})
    for (const char* equations : {"ideal", "penalty", "augmented_lagrangian", "relative", "relative_augmented_lagrangian"}) {
      Model model = driven_arm("speed = 0", equations, "0", fmt::format("ideal = true\n[force.F]\non = \"a.T\"\nforce = [0, \"{}\"]", at.load));
      model.gravity = {};
      const Trajectory run = completed(model);
      const double gives_way = std::string(equations) == "relative" ? 2e-3 : 1e-4;  // the servo deflects: 100.15 N of the short load, and 100.17 N on free bodies
      EXPECT_NEAR(run.joints[0].peak, at.peak, gives_way * at.peak) << at.load << ", " << equations;
      EXPECT_NEAR(run.joints[0].rms, at.rms, 1e-3 * at.rms) << at.load << ", " << equations;
    }
}

// The compressor starts at rest, where the gas force jumps; its valves are kinks.
TEST(Ideal, CompressorIsThatOfStiffJoints) {
  const Trajectory ideal = ideal_run("slider_crank"), stiff = simulate(reference::mechanism("slider_crank", {}));
  ASSERT_EQ(ideal.n_rows(), stiff.n_rows());
  for (std::size_t j = 0; j < ideal.joints.size(); ++j)
    EXPECT_NEAR(ideal.joints[j].rms, stiff.joints[j].rms, 1e-2 * stiff.joints[j].rms) << ideal.joints[j].name;  // the gas force jumps at its peak, and stiff joints ring
  const double speed = value(stiff, stiff.n_rows() - 1, "body.crank.spin");
  EXPECT_NEAR(value(ideal, ideal.n_rows() - 1, "body.crank.spin"), speed, 1e-3 * speed);
}

TEST(Ideal, OtherMethodsAreRefusedWhereTheyStand) {
  EXPECT_THROW(reference::mechanism("four_bar", {"simulate.equations=\"ideal\"", "simulate.method=\"radau\""}), InputError);
}

// Bushings and bearings remain force laws next to ideal joints: they begin with the deflections that carry their loads, and the run names them.
TEST(Ideal, LawsThatStayBeginLoaded) {
  Model beam = reference::test_model("beam_on_three_bushings"), rotor = reference::test_model("rotor_on_balls");
  beam.simulate.equations = rotor.simulate.equations = Equations::kIdeal;
  const Trajectory still = reference::completed(beam), turning = reference::completed(rotor);
  const std::array<double, 3> carried{222.360, 549.360, 209.280};  // by hand: two equations of equilibrium, and deflections on one line
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(still.joints[j].peak, carried[j], 1e-3);
    EXPECT_NEAR(reference::value(still, 0, "joint." + still.joints[j].name + ".on_beam.fy[world]"), carried[j], 1e-3);
  }
  EXPECT_NEAR(turning.joints[0].peak, 98.1 + 50, 0.2);
  EXPECT_NE(turning.notes.front().find("joints that remain force laws among ideal joints: brg"), std::string::npos) << turning.notes.front();
}

// They also begin with the rates of the slow motion: from its first row on, a bushing in a slider-crank at speed carries what it carries one turn later.
TEST(Ideal, LawsThatStayBeginOnTheirSlowMotion) {
  Model model = reference::test_model("slider_crank_with_bushing");
  model.simulate.equations = Equations::kIdeal;
  const Trajectory run = reference::completed(model);
  const std::size_t turn = static_cast<std::size_t>(std::lround(2 * std::numbers::pi / 50 / model.simulate.output_step));
  for (std::size_t row = 0; row < 5; ++row)
    EXPECT_NEAR(reference::value(run, row, "joint.B.on_pis.fx[world]"), reference::value(run, row + turn, "joint.B.on_pis.fx[world]"), 0.05) << row;
}

// A contact's damping depends on the speed at which it was touched, which these equations do not keep: no result instead of a wrong one.
TEST(Ideal, LawsThatRememberAreRefused) {
  Model model = reference::mechanism("hopper");
  for (const Equations equations : {Equations::kIdeal, Equations::kPenalty}) {
    model.simulate.equations = equations;
    try {
      simulate(model);
      ADD_FAILURE() << "not refused";
    } catch (const AssemblyError& error) {
      EXPECT_NE(std::string(error.what()).find("joint ground: equations with ideal joints do not integrate the states of its law"), std::string::npos) << error.what();
    }
  }
}

// Laws that stay among ideal joints keep the friction that needs no states: here that of a damped pendulum in a bushing.
TEST(Ideal, SmoothFrictionOfAJointThatStaysALaw) {
  const std::string text = R"toml(
format = 1
name = "Pendulum in rubber"
[simulate]
duration = "1 s"
tolerance = 1e-6
[body.rod]
mass = "1 kg"
inertia = 0.1
position = [0.5, 0]
angle = 0
markers.P = [-0.5, 0]
[ground.markers]
P = [0, 0]
[joint.P]
type = "revolute"
between = ["ground.P", "rod.P"]
law = "bushing"
stiffness = 1e5
damping = 500
friction = "brown-mcphee"
friction_coefficient = 0.3
pin_radius = "50 mm"
)toml";
  const Trajectory laws = reference::completed(parse_model(text, "rubber.toml"));
  EXPECT_GT(laws.energy.dissipated, 0.2);
  for (const char* equations : {"ideal", "augmented_lagrangian"}) {
    const Trajectory run = reference::completed(parse_model(text, "rubber.toml", {std::string("simulate.equations=\"") + equations + "\"", "simulate.tolerance=1e-4"}));
    EXPECT_NEAR(run.energy.dissipated, laws.energy.dissipated, 1e-3 * laws.energy.dissipated) << equations;
  }
}

}  // namespace
}  // namespace pintle
