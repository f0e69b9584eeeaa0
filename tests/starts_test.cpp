// Starts that users have met: where the positions, speeds and preloads of a run's first instant come from, in whole runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "base/constants.h"
#include "base/tables/monotone_table.h"
#include "pintle/simulate.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::test_model;
using reference::value;

// The stiffness of its pin moves the bob in two modes, whose masses differ by a factor of up to 1e8: both have to be found. With the frequencies of the pin's axes, which
// are those of the lighter one wherever the arm lies between them, the force was 2.5 N too small at 1e-7 kg m^2.
TEST(Starts, APointMassStartsWithItsWeight) {
  const double weight = 2 * kStandardGravity;
  for (const char* inertia : {"1e-4", "1e-7", "1e-8"}) {
    const Trajectory run = completed(test_model("point_mass", {std::string("body.bob.inertia=") + inertia}));
    EXPECT_NEAR(std::hypot(value(run, 0, "joint.pin.on_bob.fx[world]"), value(run, 0, "joint.pin.on_bob.fy[world]")), weight * std::cos(1.0), 1e-3) << inertia;
    EXPECT_NEAR(run.joints.at(0).peak, weight * (3 - 2 * std::cos(1.0)), 3e-3) << inertia;
  }
}

// A belt only pulls. It starts with the pretension of its spans, not with the push that their motion would require of rods. The first pulley's bearing carries
// two spans of 100 N, along an outer and an inner tangent.
TEST(Starts, ABeltWithPretensionPullsFromTheStartOn) {
  const Trajectory run = completed(test_model("belt_with_tensioner"));
  const double outer = std::asin((0.06 - 0.05) / 0.4), centres = std::hypot(0.2, 0.12), inner = std::atan2(-0.12, 0.2) + std::asin((0.05 - 0.03) / centres);
  EXPECT_NEAR(value(run, 0, "joint.A.on_w1.fx[world]"), -100 * (std::cos(outer) + std::cos(inner)), 1.5);  // the bearings deflect by 2 um each
  EXPECT_LT(run.joints[0].peak, 230);
  EXPECT_EQ(std::count_if(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("transient-free") != std::string::npos; }), 0);
}

// Where a taut rope would have to push, the others carry the load from the start on.
TEST(Starts, RopesThatTheLoadSlackensCarryNothing) {
  const Trajectory bar = completed(test_model("bar_on_three_ropes"));
  EXPECT_EQ(value(bar, 0, "joint.A.on_bar.fy[world]"), 0);
  EXPECT_NEAR(value(bar, 0, "joint.B.on_bar.fy[world]"), 9.80665 + 1000 - 900, 1e-2);
  EXPECT_NEAR(bar.joints[2].peak, 900, 1e-2);
  const Trajectory belt = completed(test_model("belt_without_pretension"));
  EXPECT_EQ(value(belt, 0, "joint.low.tension"), 0);
  EXPECT_NEAR(value(belt, 0, "joint.up.tension"), 200, 1e-2);
  EXPECT_NEAR(belt.joints[3].peak, 200, 1e-2);
}

// One rope that keeps its length leaves the others slack: with all held at once, no position of the plate would fit.
TEST(Starts, OneOfThreeRopesCarriesAPlateBesideItsCentre) {
  const Trajectory run = completed(test_model("plate_on_ropes_beside_its_centre"));
  EXPECT_EQ(run.joints[0].peak, 0);
  EXPECT_EQ(run.joints[1].peak, 0);
  EXPECT_NEAR(value(run, 0, "joint.r2.on_pl.fy[world]"), 10 * 9.80665 / (1 + 10 * 0.1 * 0.1), 1e-2);
}

// A mesh's separating force carries nothing by itself, and makes no joint redundant: both meshes start with their load, 500 N / cos 20 deg in the second.
TEST(Starts, MeshesOfTablesInSeriesStartWithTheirLoad) {
  const Trajectory run = completed(test_model("two_meshes_of_tables"));
  EXPECT_NEAR(run.joints[4].peak, 500 / std::cos(20 * std::numbers::pi / 180), 0.05);
  EXPECT_NEAR(value(run, 0, "joint.g2.on_s.m[world]"), 40, 1e-2);
}

// m a = 1.5 kg r w^2 (1 + r/l) and the rod's share, whatever rubs in the slide: one turn later the bearing carries the same. The bristles' dampers, at the rates
// that the slide soon reaches, are no part of the friction at its start; they made 1 % of its force.
TEST(Starts, BristlesAtADeadCentreCarryNoMoreThanTheirFriction) {
  const Trajectory run = completed(test_model("slide_with_bristles_at_dead_centre"));
  for (std::size_t row = 0; row < 4; ++row) EXPECT_NEAR(value(run, row, "joint.O.on_crank.fx[world]"), value(run, row + 360, "joint.O.on_crank.fx[world]"), 1) << row;
}

// The wheel rolls on its rack. Its position in the plane changes the roundoff of its gaps, which used to ring with up to 1e-4 of its force.
TEST(Starts, AWheelOnARackStartsAlikeWhereverItStands) {
  const Trajectory here = completed(test_model("eccentric_wheel_on_a_rack")), there = completed(test_model("eccentric_wheel_on_a_rack", {"parameters.x=\"3 m\"", "parameters.y=\"-2 m\""}));
  for (std::size_t row = 0; row < here.n_rows(); ++row)
    ASSERT_NEAR(value(here, row, "joint.guide.on_wheel.f2[joint]"), value(there, row, "joint.guide.on_wheel.f2[joint]"), 1e-5) << row;
}

// A cart and its wheels, with the cart's velocity and the wheels' spins stated, move as stated whichever the file lists first.
TEST(Starts, VelocitiesDoNotDependOnTheOrderOfBodies) {
  const Model as_listed = test_model("cart_put_on_the_road");
  Model reversed = as_listed;
  std::reverse(reversed.bodies.begin(), reversed.bodies.end());
  const Trajectory run = completed(as_listed), other = completed(reversed);
  for (const char* column : {"body.cart.spin", "body.wl.vx", "body.wr.vx"}) EXPECT_NEAR(value(run, 0, column), value(other, 0, column), 1e-6) << column;
}

// The spring presses the follower onto the base circle with 40 N and its weight; the cam's bearing carries both and the weight of the cam.
TEST(Starts, ABearingOfBallsWithoutPlayDoesNotThrowAFollowerOffItsCam) {
  const Model model = test_model("cam_on_ball_bearing");
  const Trajectory run = completed(model);
  EXPECT_NEAR(value(run, 0, "body.fol.y"), 0.09, 1e-5);
  EXPECT_NEAR(value(run, 0, "spring.sp.force"), -40, 1e-2);
  EXPECT_LT(run.joints[0].peak, 200);
}

// At first only roundoff presses the guide: its friction must not exceed what its load allows.
TEST(Starts, AGuideThatNothingPressesDoesNotJam) {
  Model model = test_model("cam_on_ball_bearing");
  model.joints[0].law = {};
  const Trajectory run = completed(model);
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double across = std::abs(value(run, i, "joint.guide.on_fol.f2[joint]")), couple = std::abs(value(run, i, "joint.guide.on_fol.m[world]"));
    EXPECT_LE(std::abs(value(run, i, "joint.guide.friction")), 0.1 * std::max(across, 2 * couple / 0.04) + 1e-5) << i;
  }
}

// A ball bearing has no stiffness at its centre. It starts at the deflection that carries its load nevertheless.
TEST(Starts, BearingsOfBallsStartWithTheForcesOfLinearPins) {
  const Model balls = test_model("four_bar_of_ball_bearings");
  Model pins = balls;
  for (Joint& joint : pins.joints) joint.law = {};
  const Trajectory run = completed(balls), other = completed(pins);
  for (const char* column : {"joint.O.on_c.fx[world]", "joint.O.on_c.fy[world]", "joint.P.on_ground.fx[world]"}) EXPECT_NEAR(value(run, 0, column), value(other, 0, column), 2) << column;
  EXPECT_NEAR(run.joints[0].peak, other.joints[0].peak, 2e-3 * other.joints[0].peak);
}

// Sweeps that have not converged give no start: the mechanism begins at rest, with the pressure times the area in its cylinder.
TEST(Starts, AMechanismAtRestStaysAtRestWhereNoSlowMotionIsFound) {
  const Trajectory run = completed(test_model("scissor_lift_at_rest"));
  EXPECT_LT(run.energy.kinetic_start, 1e-6);
  EXPECT_NEAR(run.joints.back().peak, 7e6 * kPi / 4 * 0.063 * 0.063, 1);
}

// The start is sought with a linearised film, which neither ends at the bush nor stiffens there: a start whose load the film itself does not carry is rejected.
// The largest force is that of the motion, 2.9 to 3.3 kN; it was up to 124 kN at t = 0, with the pin four clearances off.
TEST(Starts, APinInOilStartsInItsBush) {
  for (const double angle : {30.0, 60.0, 90.0, 150.0})
    for (const char* friction : {"stribeck", "none"}) {
      const Trajectory run = completed(test_model("crank_in_oil_film", {fmt::format("body.crank.angle=\"{} deg\"", angle), fmt::format("joint.way.friction=\"{}\"", friction)}));
      EXPECT_LT(value(run, 0, "joint.O2.eccentricity"), 1) << angle << ", " << friction;
      EXPECT_NEAR(run.joints[0].peak, 3100, 200) << angle << ", " << friction;
    }
}

// An arm on a stiff rubbing pin is eliminated before the strut that carries it, or after. 4617 N in both; it was 382,156 N in the other order, in which the arm's
// block, nearly singular, lost the strut's mass.
TEST(Starts, ForcesOfARubbingStrutDoNotDependOnTheOrderOfBodies) {
  Model as_listed = test_model("strut_with_rubbing_pin");
  as_listed.simulate.duration = 0.002;
  Model reversed = as_listed;
  std::reverse(reversed.bodies.begin(), reversed.bodies.end());
  const Trajectory run = completed(as_listed), other = completed(reversed);
  for (const char* column : {"joint.pivot.on_arm.fx[world]", "joint.pivot.on_arm.fy[world]", "joint.guide.on_fuselage.m[world]"})
    EXPECT_NEAR(value(run, 0, column), value(other, 0, column), 0.1) << column;
  EXPECT_LT(std::abs(value(other, 0, "joint.pivot.on_arm.fx[world]")), 5000);
}

// Bristles do not bend in the short motion on which the slow start is sought: the guide's couple varies smoothly with the radius of the rubbing pin.
TEST(Starts, BristlesOfAPinAtRestDoNotMoveTheSoftGuideBesideIt) {
  Model model = test_model("strut_with_rubbing_pin");
  model.simulate.duration = 0.002;
  Joint& pivot = model.joints[1];
  ASSERT_EQ(pivot.name, "pivot");
  double before = 0;
  for (const double radius : {0.003, 0.005, 0.008, 0.010, 0.015}) {
    pivot.friction.values["pin_radius"] = {radius};
    const Trajectory run = completed(model);
    const double couple = value(run, 0, "joint.guide.on_fuselage.m[world]");
    EXPECT_NEAR(std::abs(couple), 130, 30) << radius;
    if (before != 0) {
      EXPECT_NEAR(couple, before, 25) << radius;
    }
    before = couple;
  }
}

std::string notes_of(Model model) {
  model.simulate.duration = 1e-3;
  std::string all;
  for (const std::string& note : simulate(model).notes) all += note + '\n';
  return all;
}

Marker& marker_of(Model& model, const std::string& body, const std::string& name) {
  for (Body& b : model.bodies)
    for (Marker& marker : b.markers)
      if (b.name == body && marker.name == name) return marker;
  throw std::logic_error("no marker " + body + "." + name);
}

TEST(Starts, ABodyThatAssemblyTurnsFarIsNoted) {
  Model model = reference::mechanism("slider_crank");
  marker_of(model, "piston", "skirt").axis = 0;
  EXPECT_NE(notes_of(model).find("body piston: assembly turned it by 90 deg"), std::string::npos);
}

// A rod whose end is given in millimetres, as metres.
TEST(Starts, ABodyThatAssemblyMovesFarIsNoted) {
  Model model = reference::mechanism("slider_crank");
  EXPECT_EQ(notes_of(model).find("assembly moved"), std::string::npos);
  marker_of(model, "rod", "B").position[0] *= 1000;
  const std::string notes = notes_of(model);
  EXPECT_NE(notes.find("body piston: assembly moved it by"), std::string::npos) << notes;
  EXPECT_NE(notes.find("is a unit missing?"), std::string::npos) << notes;
}

// The motor sets the speed at which its crank starts; a note says so if another speed is stated.
TEST(Starts, AVelocityThatIsReplacedIsNoted) {
  Model model = test_model("two_bouncing_pins");
  EXPECT_EQ(notes_of(model).find("not with the stated"), std::string::npos);
  Body& crank = model.bodies[0];
  ASSERT_TRUE(crank.spin.has_value());
  const double right = *crank.spin;
  crank.spin = -2 * right;
  const std::string notes = notes_of(model);
  EXPECT_NE(notes.find(fmt::format("body crank: it starts with a spin of {:.4g} rad/s, not with the stated {:.4g} rad/s", right, -2 * right)), std::string::npos) << notes;
  crank.spin = 0;
  EXPECT_NE(notes_of(model).find("body crank: stated at rest, but moving at the start: joints or motors require it"), std::string::npos);
  crank.spin.reset();
  model.bodies[0].velocity = Vec2{0, 3};
  EXPECT_NE(notes_of(model).find("not with the stated (0, 3) m/s"), std::string::npos);
}

// Where its table gives no force, a pad holds nothing: the hammer keeps its place and its speed, and is stopped by what the table stores.
TEST(Starts, WhatATableLeavesFreeStartsWhereItIs) {
  const Trajectory run = completed(test_model("hammer_thrown_at_a_felt_pad"));
  EXPECT_EQ(value(run, 0, "body.hammer.x"), -0.01);
  EXPECT_EQ(value(run, 0, "body.hammer.vx"), 3);
  const MonotoneTable felt({-0.02, 0, 0.02}, {0, 0, 200});
  double depth = 0, beyond = 0.02;
  while (beyond - depth > 1e-12) (felt.integral(0.5 * (depth + beyond)) < 0.5 * 9e-3 * 9 ? depth : beyond) = 0.5 * (depth + beyond);
  EXPECT_NEAR(run.joints[1].peak, felt.value(depth), 1e-5 * felt.value(depth));
}

// A lever 18 mm above its cam is not assembled. After a raw start, which moves nothing that is stated, it falls onto the cam.
TEST(Starts, AContactThatNothingBringsTogetherStartsApartWhereItIsRaw) {
  Model model = test_model("lever_above_a_cam");
  try {
    simulate(model);
    FAIL() << "assembled";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("Everything else closes if bodies may start apart (cam): if that is meant, try start = \"raw\""), std::string::npos) << error.what();
  }
  model.simulate.start = Start::kRaw;
  const Trajectory run = completed(model);
  for (const char* column : {"body.cam.x", "body.cam.y", "body.cam.angle", "joint.cam.contact_force"}) EXPECT_EQ(value(run, 0, column), 0) << column;
  EXPECT_NEAR(value(run, 0, "body.lever.angle"), 165 * std::numbers::pi / 180, 1e-12);
  for (const LoadSummary& joint : run.joints) EXPECT_LT(joint.peak, 600) << joint.name;
}

// Closed, the contact with the cam would push the valve through its seat.
TEST(Starts, AContactThatAStopKeepsOpenStartsApart) {
  for (const Start start : {Start::kAssembled, Start::kSeated, Start::kUnloaded, Start::kRaw}) {
    Model model = test_model("valve_with_lash");
    model.simulate.start = start;
    const Trajectory run = completed(model);
    const bool loaded = start == Start::kAssembled || start == Start::kSeated;  // pressed onto its stop by its spring and its weight
    EXPECT_NEAR(value(run, 0, "joint.guide.slide"), loaded ? -(260 + 0.14 * 9.80665) / (6e7 + 32e3) : 0, 1e-9);
    EXPECT_EQ(value(run, 0, "joint.cam.contact_force"), 0);
    EXPECT_NEAR(run.joints.at(1).peak, 2350, 2) << run.joints.at(1).name;  // where it closes, at 34.5 ms
    const bool noted = std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("bodies that touch in cam start apart") != std::string::npos; });
    EXPECT_EQ(noted, start != Start::kRaw);
  }
}

// A spring is a load that follows from the positions. Where it is stiffer than the motor beside it, passes that find the motor's force and then the position diverge; an arm on a
// spring of 400 N*m/rad started 24 degrees above where it rests, with 75 times its force; with 200 N*m/rad the passes alternated between two positions.
TEST(Starts, AnArmOnASpringStifferThanItsMotorStartsAtRest) {
  for (const double spring : {100.0, 190.0, 200.0, 210.0, 300.0, 400.0, 2000.0, 20000.0, 2e6}) {
    const Trajectory run = completed(test_model("arm_on_a_stiff_spring", {"torsion_spring.t.stiffness=" + std::to_string(spring), "simulate.duration=0.1"}));
    const double angle = value(run, 0, "body.arm.angle");
    EXPECT_NEAR(-(spring + 200) * angle, 2 * 9.80665 * 0.2 * std::cos(angle), 1e-5) << spring;
    EXPECT_NEAR(run.joints[0].peak, 2 * 9.80665, 1e-3) << spring;
  }
}

// A spring that is preloaded as assembled moves a lever far if the motor beside it, which is softer by a factor of 250, has to balance it alone.
TEST(Starts, ALeverOnAPreloadedSpringStartsWhereItRests) {
  const Trajectory run = completed(test_model("lever_on_a_preloaded_spring")), settled = completed(test_model("lever_on_a_preloaded_spring", {"simulate.start=\"settled\""}));
  EXPECT_NEAR(value(run, 0, "spring.s.force"), value(settled, 0, "spring.s.force"), 1e-3);
  EXPECT_NEAR(run.joints[0].peak, settled.joints[0].peak, 1e-3);
  // Nothing rings where everything rests, whatever the sweeps find.
  EXPECT_EQ(notes_of(test_model("lever_on_a_preloaded_spring", {"motor.m.stiffness=1e5", "motor.m.damping=345", "spring.s.stiffness=1"})).find("transient-free"), std::string::npos);
}

// What a motor that yields and a stop carry together follows from both stiffnesses. The stop is stiffer by up to 5000 times: the motor's share is found with it, and the arm, its pin
// and the run's largest force are those of an arm that rests.
TEST(Starts, AMotorSharesItsLoadWithTheStopAtWhichItBegins) {
  constexpr double kWeight = 2 * 9.80665, kStop = 1e5;
  for (const double motor : {20.0, 200.0, 400.0, 1000.0, 1e5})
    for (const char* friction : {"coulomb", "none"}) {
      const Trajectory run = completed(test_model("arm_on_its_stop", {"motor.drive.stiffness=" + std::to_string(motor), "simulate.duration=0.4", "joint.pin.pin_radius=0.01", "joint.pin.friction=\"" + std::string(friction) + "\""}));
      const double turned = -kWeight * 0.2 / (kStop + motor);
      const bool rubs = std::string(friction) == "coulomb";  // stuck, friction takes a part of the load
      if (!rubs) {
        EXPECT_NEAR(value(run, 0, "body.arm.angle"), turned, 2e-4 * std::abs(turned)) << motor;  // a motor with a time constant of 0.2 s has not quite settled
        EXPECT_NEAR(value(run, 0, "joint.pin.stop_moment"), -kStop * turned, 2e-4 * kStop * std::abs(turned)) << motor;
      }
      EXPECT_NEAR(run.joints[0].peak, kWeight, 1e-4) << motor << friction;
    }
}

// The same where the motor is in another joint of the loop. The motor's target moves the crank 0.05 deg off its stop as assembled, and the load moves it back: nothing moves.
TEST(Starts, AFourBarRestsOnAStopBesideItsMotor) {
  const Trajectory run = completed(test_model("four_bar_on_its_stop"));
  for (const LoadSummary& joint : run.joints) EXPECT_NEAR(joint.peak, joint.rms, 1e-5 * joint.peak) << joint.name;
  EXPECT_NEAR(value(run, 0, "joint.A.stop_depth"), 9.92e-5, 1e-6);
  EXPECT_TRUE(std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("start at a stop, to which the loads of t = 0 push them: A") != std::string::npos; }));
}

// A beam that hangs free in its bush at the start falls onto it, and the largest force of the run may be that of this impact.
TEST(Starts, PinsThatStartInTheMiddleOfTheirPlayAreNoted) {
  const std::string notes = notes_of(reference::test_model("pump_jack_with_loose_saddle"));
  EXPECT_NE(notes.find("joints start in the middle of their play (saddle) and strike its sides first"), std::string::npos) << notes;
  EXPECT_EQ(notes_of(reference::mechanism("four_bar")).find("start in the middle"), std::string::npos);
  EXPECT_EQ(notes_of(test_model("rotor_on_balls", {"joint.brg.play=\"20 um\""})).find("start in the middle"), std::string::npos);  // it is pressed through its play
}

// Differentiated over nanoseconds, roundoff of the gaps becomes a speed: the velocities of a start are those of assembly, whatever the duration of the run.
TEST(Starts, VelocitiesAreThoseOfAssemblyWhateverTheDuration) {
  for (const char* duration : {"0.05", "0.2", "1"}) {
    const std::vector<std::string> run{std::string("simulate.duration=") + duration, std::string("simulate.output_step=") + duration, "simulate.start=\"assembled\"", "simulate.tolerance=0.01"};
    const auto spin = [&](const Model& model, const char* column) { return value(simulate(model), 0, column); };
    EXPECT_NEAR(spin(reference::mechanism("worn_linkage", run), "body.coupler.spin"), -8.627, 1e-3) << duration;
    EXPECT_NEAR(spin(test_model("toggle_press_with_loose_pins", run), "body.con.spin"), 1.2422, 1e-3) << duration;
    std::vector<std::string> rubbing = run;
    rubbing.insert(rubbing.end(), {"defaults.joint.friction=\"coulomb\"", "defaults.joint.pin_radius=5e-3"});
    EXPECT_NEAR(spin(test_model("scissor_jack", rubbing), "body.car.vy"), 0, 1e-5) << duration;
  }
}

// Neither a mechanism that hangs still nor bodies that no joint touches can ring.
TEST(Starts, NoTransientIsNotedWhereNothingMoves) {
  EXPECT_EQ(notes_of(test_model("scissor_jack")).find("no transient-free start"), std::string::npos);
  EXPECT_EQ(notes_of(test_model("ball_on_stiff_linear_contact", {"simulate.duration=0.1"})).find("no transient-free start"), std::string::npos);
}

TEST(Starts, MissingUnitsAreNoted) {
  EXPECT_EQ(notes_of(reference::mechanism("slider_crank_clearance")).find("check its unit"), std::string::npos);
  EXPECT_NE(notes_of(reference::mechanism("slider_crank_clearance", {"joint.B.pin_radius=9.5"})).find("joint B: its pin_radius of 9.5 m is larger than the whole mechanism (0.17 m): check its unit; a number alone is in metres"), std::string::npos);
  EXPECT_NE(notes_of(reference::mechanism("slider_crank_clearance", {"joint.B.clearance=0.05"})).find("joint B: its clearance of 0.05 m is larger than the radius of its pin (0.0095 m)"), std::string::npos);
  EXPECT_NE(notes_of(reference::mechanism("four_bar", {"body.coupler.angle=40"})).find("body coupler: its angle of 40 rad is 6.37 turns: without a unit angles are radians"), std::string::npos);
  EXPECT_EQ(notes_of(reference::mechanism("door_stops")).find("without a unit"), std::string::npos);  // its stops are angles
}

TEST(Starts, PulleysThatOverlapAreNoted) {
  EXPECT_EQ(notes_of(reference::mechanism("belt_drive")).find("overlap"), std::string::npos);
  EXPECT_NE(notes_of(reference::mechanism("belt_drive", {"parameters.apart=\"150 mm\""})).find("joint upper: its discs overlap by 0.05 m"), std::string::npos);
}

// Methods that do not carry gaps cannot tell a rope that is slack by more than half of what a turn of the drum winds from a taut one: the run says so, and is not
// "completed".
TEST(Starts, ARopeThatIsSlackByATurnIsFollowedOrEndsTheRun) {
  const Trajectory followed = completed(test_model("rope_slack_by_a_turn"));
  EXPECT_EQ(at_end(followed, "joint.rope.tension"), 0);
  EXPECT_NEAR(at_end(followed, "t"), 0.3, 1e-12);
  for (const char* method : {"dopri5", "ode15s"}) {
    const Trajectory run = simulate(test_model("rope_slack_by_a_turn", {std::string("simulate.method=") + method}));
    EXPECT_EQ(run.outcome, Outcome::kEnergyOpen) << method;
    EXPECT_NE(run.message.find("joint rope is slack by "), std::string::npos) << run.message;
    EXPECT_NEAR(run.t_end, 0.146, 1e-2) << method;  // by half a turn
  }
}

TEST(Starts, MotorsThatContradictEachOtherAreNamed) {
  Model model = test_model("two_motors_on_a_four_bar", {"simulate.duration=0.01"});
  EXPECT_NE(notes_of(model).find("motors n, m together drive one degree of freedom"), std::string::npos) << notes_of(model);
  model.motors.pop_back();
  EXPECT_EQ(notes_of(model).find("together drive"), std::string::npos);
}

// If a soft thread had to carry the inertia of its lever from the first instant on, its preload would turn this lever twice.
TEST(Starts, APreloadTurnsNoBodyManyTimes) {
  const Trajectory run = completed(test_model("check_spring_lever"));
  EXPECT_NEAR(value(run, 0, "body.lever.angle"), 0, 1e-3);
  EXPECT_NEAR(run.joints.at(2).peak, 3.4713, 0.03) << run.joints.at(2).name;  // with ideal joints
}

// A misfit of 0.2 mm makes the parallelogram's motion a mode of 1 rad/s. The start followed the misfit along it, 25 mm far (in relative coordinates half a metre), to joint forces of
// 10 kN, and took half of the crank's spin.
TEST(Starts, AMisfitOfRedundantCranksMovesThemNoFurther) {
  for (const char* equations : {"newtonian", "relative"}) {
    const Trajectory run = completed(test_model("parallelogram_of_three_cranks", {std::string("simulate.equations=") + equations}));
    EXPECT_NEAR(value(run, 0, "body.coupler.x"), 1, 2e-4) << equations;
    EXPECT_NEAR(value(run, 0, "body.coupler.y"), 0.5, 2e-6) << equations;
    EXPECT_NEAR(value(run, 0, "body.a.spin"), 3, 0.4) << equations;
    for (const char* joint : {"A.on_a", "B.on_b", "C.on_c", "D.on_coupler", "E.on_coupler", "F.on_coupler"})
      for (const char* component : {".fx[world]", ".fy[world]"}) EXPECT_LT(std::abs(value(run, 0, std::string("joint.") + joint + component)), 50) << joint;
  }
}

// The reaction of a rod that slides on its tip includes the friction of its slip: m g/(1 + 3 cos^2 + 3 mu sin cos).
TEST(Starts, ATipThatSlidesRubsFromTheStartOn) {
  for (const double friction : {0.0, 0.2, 0.5}) {
    const Trajectory run = completed(test_model("rod_that_slides_on_its_tip", {"joint.floor.friction_coefficient=" + std::to_string(friction)}));
    const double s = std::sin(kTurn / 6), c = std::cos(kTurn / 6), expected = kStandardGravity / (1 + 3 * c * c + 3 * friction * s * c);
    EXPECT_NEAR(value(run, 0, "joint.floor.contact_force"), expected, 2e-3 * expected) << friction;
    EXPECT_LT(run.joints.at(0).peak, 1.05 * expected * std::hypot(1, friction)) << friction;
  }
}

// The bodies of the joint do not touch there; the pole's sleeve is at the angle that is held.
TEST(Starts, WhatIsHeldMaySayWhereAJointIsInItsPlay) {
  EXPECT_NEAR(value(completed(test_model("sleeve_tilted_in_its_play")), 0, "body.s.angle"), 0.05, 1e-12);
  EXPECT_THROW(simulate(test_model("sleeve_tilted_in_its_play", {"body.s.angle=0.15"})), AssemblyError);  // 1.5 mm at the ends, of 1 mm
}

}  // namespace
}  // namespace pintle
