// Stops of angles and slides in whole runs: closed forms of bouncing and of rest, balances, every method.
#include <gtest/gtest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
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

constexpr double kDoorMass = 2, kInertia = 0.05;

// A mass on a slide with stops at -0.1 m and 0.2 m, thrown at 0.5 m/s from the middle between them.
Model thrown_door(const std::string& stops, const std::string& duration = "2 s") {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "{}"
[ground.markers]
o = [0, 0]
[body.block]
mass = {}
inertia = 0.01
position = [0.05, 0]
velocity = [0.5, 0]
angle = 0
hold = ["x"]
markers.c = [0, 0]
[joint.slide]
type = "prismatic"
between = ["ground.o", "block.c"]
lower_stop = "-100 mm"
upper_stop = "200 mm"
{}
)toml",
                                 duration, kDoorMass, stops),
                     "thrown.toml");
}

// A door on a hinge without gravity, turned by a torque.
Model door(const std::string& stops, double torque, double spin, const std::string& more = "") {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "4 s"
tolerance = 1e-6
[ground.markers]
o = [0, 0]
[body.leaf]
mass = 1
inertia = {}
position = [0, 0]
angle = 0.1
spin = {}
hold = ["angle"]
markers.c = [0, 0]
[joint.hinge]
type = "revolute"
between = ["ground.o", "leaf.c"]
{}
[motor.push]
joint = "hinge"
torque = "{} N*m"
{}
)toml",
                                 kInertia, spin, stops, torque, more),
                     "door.toml");
}

// Between a release and the next touch the mass flies the whole distance between the stops, at a speed that each impact has multiplied by e.
TEST(Stops, BetweenTwoHardStopsAMassKeepsTheRestitutionAskedFor) {
  const double e = 0.7, way = 0.3;
  for (const double exponent : {1.0, 1.5}) {
    const Followed run = follow(thrown_door(fmt::format("stops = \"hard\"\nstop_stiffness = 1e6\nstop_exponent = {}\nstop_restitution = {}\nstop_least_speed = 1e-6", exponent, e), "4 s"), 1e-10, 4, {});
    ASSERT_GE(run.contacts.size(), 5u);
    EXPECT_NEAR(run.contacts[0].t, 0.15 / 0.5, 1e-9);
    double speed = 0.5;
    for (std::size_t i = 1; i + 1 < run.contacts.size(); i += 2) {
      speed *= e;
      EXPECT_EQ(run.contacts[i].border, contacts::kLetGo);
      EXPECT_NEAR(run.contacts[i + 1].t - run.contacts[i].t, way / speed, 1e-7 * way / speed) << exponent << ' ' << i;
    }
    EXPECT_NEAR(std::abs(run.end.v[0][0]), speed * (run.contacts.size() % 2 == 0 ? e : 1), 1e-8);
    EXPECT_NEAR(run.end.dissipated, 0.5 * kDoorMass * (0.25 - run.end.v[0][0] * run.end.v[0][0]), 1e-8);
  }
}

// The first half of an impact against a lossless spring: a quarter of its period to the depth v sqrt(m/k), half a period in all.
TEST(Stops, AnElasticStopIsHalfAPeriodOfItsSpring) {
  const double k = 2e4, w = std::sqrt(k / kDoorMass);
  Model model = thrown_door(fmt::format("stops = \"hard\"\nstop_stiffness = {}\nstop_restitution = 1", k));
  const Followed run = follow(model, 1e-10, 0.5, {});
  ASSERT_EQ(run.contacts.size(), 2u);
  EXPECT_NEAR(run.contacts[1].t - run.contacts[0].t, M_PI / w, 1e-8);
  model.simulate.output_step = 1e-4;
  const Trajectory bounced = completed(model);
  double deepest = 0, force = 0;
  for (std::size_t i = 0; i < bounced.n_rows(); ++i) {
    deepest = std::max(deepest, reference::value(bounced, i, "joint.slide.stop_depth"));
    force = std::min(force, reference::value(bounced, i, "joint.slide.stop_force"));
  }
  EXPECT_NEAR(deepest, 0.5 / w, 1e-4 * 0.5 / w);
  EXPECT_NEAR(force, -k * 0.5 / w, 1e-4 * k * 0.5 / w);
  EXPECT_LT(drift(bounced), 1e-5 * 0.25);
  ASSERT_EQ(bounced.events.size(), 1u);
  EXPECT_EQ(bounced.events[0].events[0].what, "touch of the upper stop");
  const std::vector<Column>& columns = bounced.events[0].columns;
  const auto approach = static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.name == "stop_approach_speed"; }) - columns.begin());
  EXPECT_NEAR(bounced.events[0].events[0].values.at(approach), 0.5, 1e-6);
  EXPECT_EQ(columns[approach].unit, "m/s");
  EXPECT_EQ(bounced.events[0].events[1].what, "let-go of the upper stop");
  EXPECT_EQ(bounced.events[0].events[2].what, "touch of the lower stop");
}

// A moment presses a door against its stop: the door comes to rest at the depth M / k, and the stop gives -M.
TEST(Stops, ADoorRestsWhereTheStopCarriesTheMoment) {
  const double torque = 3, k = 600;
  for (const std::string stops : {"stops = \"hard\"\nstop_stiffness = 600\nstop_model = \"linear\"\nstop_damping = 8", "stops = \"cushioned\"\nstop_stiffness = 600\nstop_damping = 8\nstop_cushion = \"0.2 deg\""}) {
    const Trajectory run = completed(door("upper_stop = \"30 deg\"\n" + stops, torque, 0));
    EXPECT_NEAR(at_end(run, "joint.hinge.angle"), M_PI / 6 + torque / k, 1e-6);
    EXPECT_NEAR(at_end(run, "joint.hinge.stop_moment"), -torque, 1e-4);
    EXPECT_NEAR(at_end(run, "joint.hinge.on_leaf.m[world]"), -torque, 1e-4);
    EXPECT_NEAR(at_end(run, "joint.hinge.on_ground.m[world]"), torque, 1e-4);
    EXPECT_NEAR(at_end(run, "joint.hinge.stop_depth"), torque / k, 1e-6);
    EXPECT_LT(drift(run), 1e-4 * torque);
    EXPECT_TRUE(run.joints[0].has_moment);
    EXPECT_GE(run.joints[0].peak_moment, torque);
  }
}

// I d'' = -max(0, k d + c s(d/L) d'), by the classical method of Runge and Kutta from the touch on.
TEST(Stops, ACushionBrakesAsItsEquationSays) {
  const double spin = 3, k = 40, c = 1.5, L = 0.15, h = 1e-5;
  Model model = door(fmt::format("lower_stop = -1\nupper_stop = 0.4\nstops = \"cushioned\"\nstop_stiffness = {}\nstop_damping = {}\nstop_cushion = {}", k, c, L), 0, spin);
  model.simulate.duration = 0.4;
  const Followed run = follow(model, 1e-9, 0.4, {});
  ASSERT_GE(run.contacts.size(), 1u);
  EXPECT_NEAR(run.contacts[0].t, 0.1, 1e-9);
  const auto rate = [&](const std::array<double, 2>& y) -> std::array<double, 2> {
    const double x = std::min(1.0, y[0] / L), moment = y[0] > 0 ? std::max(0.0, k * y[0] + c * x * x * (3 - 2 * x) * y[1]) : 0;
    return {y[1], -moment / kInertia};
  };
  std::array<double, 2> y{0, spin};
  for (int i = 0; i < 30000; ++i) {
    const auto ahead = [&](const std::array<double, 2>& k1, double step) -> std::array<double, 2> { return {y[0] + step * k1[0], y[1] + step * k1[1]}; };
    const auto k1 = rate(y), k2 = rate(ahead(k1, h / 2)), k3 = rate(ahead(k2, h / 2)), k4 = rate(ahead(k3, h));
    for (int n = 0; n < 2; ++n) y[n] += h / 6 * (k1[n] + 2 * k2[n] + 2 * k3[n] + k4[n]);
  }
  EXPECT_LT(std::abs(y[1]), 0.9 * spin);  // it took speed away
  EXPECT_NEAR(run.end.q[0][2], 0.4 + y[0], 1e-6);
  EXPECT_NEAR(run.end.v[0][2], y[1], 1e-5);
  EXPECT_NEAR(run.end.dissipated, 0.5 * kInertia * (spin * spin - y[1] * y[1]) - (y[0] > 0 ? 0.5 * k * y[0] * y[0] : 0), 1e-6);
}

// One word takes the stops away; their keys wait.
TEST(Stops, NoneTakesThemAway) {
  const Model model = reference::mechanism("door_stops", {"joint.hinge.stops=\"none\""});
  EXPECT_EQ(model.joints.at(0).name, "hinge");
  EXPECT_EQ(model.joints.at(0).stops.word, "");
  try {
    reference::mechanism("air_cylinder", {"joint.thrust.stops=\"none\""});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the stroke ends somewhere"), std::string::npos) << error.what();
  }
}

// Friction with a stop is the same as without one: the joint force along the slide is the sum of both, and each has a column of its own.
TEST(Stops, FrictionAndStopsHaveColumnsOfTheirOwn) {
  const Trajectory run = completed(thrown_door("stops = \"hard\"\nstop_stiffness = 1e5\nstop_restitution = 0.6\nfriction = \"stribeck\"\nfriction_coefficient = 0.2\nstatic_friction = 0.2\nfriction_preload = 1", "1 s"));
  double most = 0, stop = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double friction = reference::value(run, i, "joint.slide.friction"), at_stop = reference::value(run, i, "joint.slide.stop_force");
    most = std::max(most, std::abs(friction));
    stop = std::max(stop, std::abs(at_stop));
    EXPECT_NEAR(friction + at_stop, reference::value(run, i, "joint.slide.on_block.f1[joint]"), 1e-9);
  }
  EXPECT_NEAR(most, 0.2, 1e-4);
  EXPECT_GT(stop, 1);
  EXPECT_LT(drift(run), 1e-5);
}

// A slot's pin moves along it between stops and turns freely; with a loose pin the stops of the angle act in addition to the clearance in its bush.
TEST(Stops, StandBesideEveryLawOfTheJoint) {
  Model slot = thrown_door("stops = \"hard\"\nstop_stiffness = 1e6");
  slot.joints[0].type = "slot";
  EXPECT_EQ(completed(slot).events[0].events[0].what, "touch of the upper stop");
  const Trajectory loose = completed(door("law = \"clearance\"\nclearance = 0.0001\ncontact_stiffness = 1e8\nrestitution = 0.5\nupper_stop = 0.4\nstops = \"hard\"\nstop_stiffness = 600\nstop_restitution = 0.3", 1, 0));
  EXPECT_NEAR(at_end(loose, "joint.hinge.stop_moment"), -1, 1e-2);
}

TEST(Stops, EveryMethodTouchesAndLetsGo) {
  for (const std::string method : {"radau", "dopri5", "ode45", "ode15s", "ode113", "ode23t", "hht", "generalised_alpha"}) {
    MethodChoice choice{.method = method};
    if (!why_not(choice).empty()) continue;
    const double tolerance = method == "radau" || method == "dopri5" ? 1e-7 : method.starts_with("ode") ? 1e-9 : 1e-8;
    const Followed run = follow(thrown_door("stops = \"hard\"\nstop_stiffness = 1e6\nstop_restitution = 0.5", "0.6 s"), tolerance, 0.6, choice);
    ASSERT_EQ(run.contacts.size(), 2u) << method;
    EXPECT_NEAR(run.contacts[0].t, 0.3, 1e-4) << method;
    EXPECT_NEAR(run.end.v[0][0], -0.25, 1e-3) << method;
  }
}

TEST(Stops, OfJointsThatAreForceLawsActInRelativeCoordinates) {
  Model model = thrown_door("stops = \"hard\"\nstop_stiffness = 1e6\nstop_restitution = 0.5", "0.6 s");
  model.simulate.equations = Equations::kRelative;
  for (const std::string method : {"radau", "dopri5"}) {
    const Followed run = follow(model, 1e-7, 0.6, {.method = method});
    ASSERT_EQ(run.contacts.size(), 2u) << method;
    EXPECT_NEAR(run.end.v[0][0], -0.25, 1e-3) << method;
  }
}

TEST(Stops, OfIdealJointsAreLostAndSaidToBe) {
  const auto says = [](const Trajectory& run) {
    return std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("joint slide is ideal: its stops are not in these equations") != std::string::npos; });
  };
  Model model = thrown_door("stops = \"hard\"\nstop_stiffness = 1e6");
  model.simulate.equations = Equations::kIdeal;
  EXPECT_TRUE(says(completed(model)));
  model.simulate.equations = Equations::kRelative;
  EXPECT_FALSE(says(completed(model)));
  model.joints[0].ideal = true;
  EXPECT_TRUE(says(completed(model)));
}

// From the start on the lever is as deep in its stop as its load requires: 30 g L/2 + 500 N L.
TEST(Stops, WhatBeginsAtAStopIsCarriedByIt) {
  const Trajectory run = completed(reference::test_model("lever_on_its_stop"));
  const double load = 30 * 9.80665 + 500, moment = 30 * 9.80665 * 0.5 + 500;
  EXPECT_NEAR(reference::value(run, 0, "joint.O.on_lever.fy[world]"), load, 1e-2);
  EXPECT_NEAR(reference::value(run, 0, "joint.O.stop_moment"), moment, 1e-2);
  EXPECT_NEAR(run.joints[0].peak, load, 1e-2);
  EXPECT_TRUE(run.notes.empty()) << run.notes.front();
  const Trajectory lifted = completed(reference::test_model("lever_on_its_stop", {"force.l.force=[0, 500]"}));
  EXPECT_EQ(reference::value(lifted, 0, "joint.O.stop_moment"), 0);
}

// The pressure presses on the stop, too: 50 bar on a piston of 50 mm, and a pull of 1000 N.
TEST(Stops, ACylinderThatBeginsAtItsStrokeEndIsCarriedByIt) {
  const Trajectory run = completed(reference::test_model("cylinder_at_its_stroke_end"));
  EXPECT_NEAR(reference::value(run, 0, "joint.c.force"), -1000, 1e-2);
  EXPECT_NEAR(reference::value(run, 0, "joint.c.stop_force"), -1000 - 50e5 * M_PI / 4 * 0.05 * 0.05, 1e-2);
  EXPECT_NEAR(run.joints[1].peak, 1000, 1e-2);
}

TEST(Stops, AStartBeyondThemIsRefused) {
  const auto message = [](const Model& model) -> std::string {
    try {
      simulate(model);
    } catch (const AssemblyError& error) {
      return error.what();
    }
    return "it ran";
  };
  const std::string stops = "lower_stop = \"-20 deg\"\nupper_stop = \"90 deg\"\nstops = \"hard\"\nstop_stiffness = 1e4";
  Model model = door(stops, 0, 0);
  model.bodies[0].angle = M_PI / 180 * 100;
  EXPECT_NE(message(model).find("joint hinge: it starts with its angle at 100 deg, beyond its upper_stop of 90 deg"), std::string::npos) << message(model);
  model.bodies[0].angle = M_PI / 180 * 350;
  EXPECT_NE(message(model).find("a whole turn apart"), std::string::npos) << message(model);
  model.bodies[0].angle = -M_PI / 180 * 10;
  EXPECT_EQ(message(model), "it ran");
}

}  // namespace
}  // namespace pintle
