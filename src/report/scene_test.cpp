#include "report/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "report/drawn_run_for_tests.h"
#include "report/outline.h"
#include "report/poses.h"

namespace pintle {
namespace {

using drawn::run_of_mechanism;
using drawn::sketch_of_mechanism;

std::size_t count_shapes(const Scene& scene, Paint paint) {
  return static_cast<std::size_t>(std::count_if(scene.shapes.begin(), scene.shapes.end(), [paint](const Shape& shape) { return shape.paint == paint; }));
}

bool inside(const Box& box, const Vec2& p) { return p[0] >= box.low[0] && p[0] <= box.high[0] && p[1] >= box.low[1] && p[1] <= box.high[1]; }

TEST(Scene, FourBarHasThreeLinksFourPinsTwoSupports) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Scene scene = make_scene(model, run.trajectory);
  EXPECT_EQ(count_shapes(scene, Paint::kLink), 3u);
  EXPECT_EQ(count_shapes(scene, Paint::kPin), 4u);
  EXPECT_EQ(count_shapes(scene, Paint::kHatch), 2u);
  EXPECT_EQ(scene.arrows.size(), 4u);
  EXPECT_EQ(scene.n_unseen, 0u);
}

// Rolling bearings in O and B, an oil film in A: the ring belongs to the first body and surrounds the pin of the second.
TEST(Scene, BearingsAreDrawnAroundTheirPins) {
  const auto [model, run] = run_of_mechanism("lubricated_crank");
  const Scene scene = make_scene(model, run.trajectory);
  EXPECT_EQ(count_shapes(scene, Paint::kOil), 1u);
  EXPECT_EQ(count_shapes(scene, Paint::kRubber), 0u);
  ASSERT_EQ(count_shapes(scene, Paint::kBall), 2u);
  EXPECT_EQ(count_shapes(scene, Paint::kPin), 3u + 2u);
  const auto balls = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.paint == Paint::kBall; });
  const auto oil = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.paint == Paint::kOil; });
  EXPECT_EQ(balls->paths.size(), 10u);
  for (const std::vector<Vec2>& ball : balls->paths) EXPECT_LT(length(ball.front()) + balls->size, oil->size);  // O is at the origin
}

// The drawing closes: the end of each link coincides with its neighbour's in every row, except for joint deflection.
TEST(Scene, LinksMeetInTheirJoints) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Scene scene = make_scene(model, run.trajectory);
  const auto point = [&](const std::string& name) {
    return std::find_if(scene.points.begin(), scene.points.end(), [&](const NamedPoint& p) { return p.name == name; })->at;
  };
  for (std::size_t row = 0; row < run.trajectory.n_rows(); row += 20) {
    const Instant instant = instant_at(scene, run.trajectory, run.trajectory.at(row, 0));
    EXPECT_LT(length(instant.place(point("crank.A")) - instant.place(point("coupler.A"))), 1e-4);
    EXPECT_LT(length(instant.place(point("coupler.B")) - instant.place(point("follower.B"))), 1e-4);
    EXPECT_LT(length(instant.place(point("follower.O4")) - Vec2{6, 0}), 1e-4);
  }
}

TEST(Scene, BoxHoldsEveryPointAndArrow) {
  const auto [model, run] = run_of_mechanism("slider_crank");
  const Scene scene = make_scene(model, run.trajectory);
  for (std::size_t row = 0; row < run.trajectory.n_rows(); row += 7) {
    const Instant instant = instant_at(scene, run.trajectory, run.trajectory.at(row, 0));
    for (const NamedPoint& point : scene.points) EXPECT_TRUE(inside(scene.box, instant.place(point.at))) << point.name;
  }
}

TEST(Scene, ArrowsCarryTheForcesOfTheTable) {
  const auto [model, run] = run_of_mechanism("four_bar");
  const Trajectory& trajectory = run.trajectory;
  const Scene scene = make_scene(model, trajectory);
  for (const LoadSummary& joint : trajectory.joints) {
    const Instant instant = instant_at(scene, trajectory, joint.peak_time);
    const auto arrow = std::find_if(scene.arrows.begin(), scene.arrows.end(), [&](const ForceArrow& a) { return a.joint == joint.name; });
    ASSERT_NE(arrow, scene.arrows.end());
    EXPECT_EQ(arrow->on, joint.second_body);
    EXPECT_NEAR(length(instant.forces[static_cast<std::size_t>(arrow - scene.arrows.begin())]), joint.peak, 1e-3 * joint.peak) << "rows are a degree of crank apart";
  }
}

// Between rows everything is interpolated linearly; outside the run the nearest end applies.
TEST(Scene, InstantsLieBetweenRows) {
  const auto [model, run] = run_of_mechanism("pendulum");
  const Trajectory& trajectory = run.trajectory;
  const Scene scene = make_scene(model, trajectory);
  const double a = trajectory.at(10, 0), b = trajectory.at(11, 0);
  const auto x = static_cast<std::size_t>(scene.bodies[0].x);
  EXPECT_NEAR(instant_at(scene, trajectory, a + 0.25 * (b - a)).poses[0].x, 0.75 * trajectory.at(10, x) + 0.25 * trajectory.at(11, x), 1e-14);
  EXPECT_EQ(instant_at(scene, trajectory, -1).poses[0].x, trajectory.at(0, x));
  EXPECT_EQ(instant_at(scene, trajectory, 1e9).poses[0].x, trajectory.at(trajectory.n_rows() - 1, x));
  EXPECT_EQ(instant_at(scene, trajectory, a).t, a);
}

// A uniform rod held at one end is drawn up to its other end, which only its inertia reveals.
TEST(Scene, RodOnAPinHasItsLength) {
  const auto [model, run] = run_of_mechanism("pendulum");
  const Scene scene = make_scene(model, run.trajectory);
  const auto bar = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.form == Form::kBar; });
  ASSERT_NE(bar, scene.shapes.end());
  const Vec2 pin = model.bodies[0].markers[0].position;
  EXPECT_NEAR(length(bar->paths[0][1] - bar->paths[0][0]), 2 * length(pin), 0.01 * length(pin));
}

// A lid of 0.6 m with a pinion of 60 mm at its hinge.
TEST(Scene, AWheelIsNotAllOfABodyThatReachesFarther) {
  const auto [model, run] = drawn::run_of(R"(
format = 1
name = "Lid"
[simulate]
duration = "10 ms"
[ground.markers]
hinge = [0, 0]
way = [0, "0.06 m"]
[body.lid]
mass = "6 kg"
inertia = "0.18 kg*m^2"
position = ["0.3 m", 0]
angle = 0
markers.hinge = ["-0.3 m", 0]
[body.rack]
mass = "0.3 kg"
inertia = "0.001 kg*m^2"
position = [0, "0.06 m"]
angle = 0
markers.way = [0, 0]
[joint.hinge]
type = "revolute"
between = ["ground.hinge", "lid.hinge"]
[joint.way]
type = "prismatic"
between = ["ground.way", "rack.way"]
[joint.mesh]
type = "rack"
between = ["lid.hinge", "rack.way"]
radius = "60 mm"
)");
  const Scene scene = make_scene(model, run.trajectory);
  const auto bar = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.form == Form::kBar && shape.body == 0; });
  ASSERT_NE(bar, scene.shapes.end());
  EXPECT_NEAR(length(bar->paths[0][1] - bar->paths[0][0]), 0.6, 1e-12);
  EXPECT_EQ(count_shapes(scene, Paint::kPitch), 1u);
}

// The lever of a shaper: a slot for the crank and one for the ram, in line. It used to be drawn in two pieces.
TEST(Scene, ABodyWithTwoSlotsIsOnePiece) {
  const auto [model, run] = drawn::run_of(R"(
format = 1
name = "Shaper"
[simulate]
duration = "0.2 s"
[ground.markers]
O = [0, 0]
P = [0, "-0.3 m"]
way = [0, "0.3 m"]
[body.crank]
mass = "1 kg"
inertia = "0.01 kg*m^2"
position = [0, 0]
angle = 0
hold = ["angle"]
spin = "30 rpm"
markers.O = [0, 0]
markers.A = ["0.1 m", 0]
[body.lever]
mass = "3 kg"
inertia = "0.1 kg*m^2"
angle = "90 deg"
markers.P = ["-0.3 m", 0]
markers.slot = [0, 0]
markers.end = ["0.3 m", 0]
[body.ram]
mass = "5 kg"
inertia = "0.1 kg*m^2"
angle = 0
markers.c = [0, 0]
[joint]
O = { type = "revolute", between = ["ground.O", "crank.O"] }
P = { type = "revolute", between = ["ground.P", "lever.P"] }
A = { type = "slot", between = ["lever.slot", "crank.A"] }
E = { type = "slot", between = ["lever.end", "ram.c"] }
way = { type = "prismatic", between = ["ground.way", "ram.c"] }
[motor.drive]
joint = "O"
speed = "30 rpm"
)");
  const Scene scene = make_scene(model, run.trajectory);
  const auto bar = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.form == Form::kBar && shape.paint == Paint::kLink && shape.body == 1; });
  ASSERT_NE(bar, scene.shapes.end());
  std::vector<std::array<double, 2>> along;  // along the lever's axis, from and to
  for (const std::vector<Vec2>& path : bar->paths) along.push_back({std::min(path.front()[0], path.back()[0]), std::max(path.front()[0], path.back()[0])});
  std::sort(along.begin(), along.end());
  double reached = along.front()[1];
  for (const auto& [from, to] : along) {
    EXPECT_LE(from, reached + 1e-6);
    reached = std::max(reached, to);
  }
  EXPECT_LT(along.front()[0], -0.299);
  EXPECT_GT(reached, 0.299);
}

TEST(Scene, GuidesAreAsLongAsTheSlide) {
  const auto [model, run] = run_of_mechanism("inverted_slider_crank");
  const Trajectory& trajectory = run.trajectory;
  const Scene scene = make_scene(model, trajectory);
  const auto guide = std::find_if(scene.shapes.begin(), scene.shapes.end(), [](const Shape& shape) { return shape.paint == Paint::kGuide; });
  ASSERT_NE(guide, scene.shapes.end());
  const auto slide = static_cast<std::size_t>(trajectory.column("joint.P.slide"));
  double low = 1e9, high = -1e9;
  for (std::size_t row = 0; row < trajectory.n_rows(); ++row) low = std::min(low, trajectory.at(row, slide)), high = std::max(high, trajectory.at(row, slide));
  const double drawn = length(guide->paths[0][1] - guide->paths[0][0]);
  EXPECT_GT(drawn, high - low);
  EXPECT_LT(drawn, high - low + 8 * scene.unit);
}

TEST(Scene, MeshActsWherePitchCirclesTouch) {
  const auto [model, run] = run_of_mechanism("gear_train");
  const Scene scene = make_scene(model, run.trajectory);
  const auto mesh = std::find_if(scene.arrows.begin(), scene.arrows.end(), [](const ForceArrow& a) { return a.joint == "mesh"; });
  ASSERT_NE(mesh, scene.arrows.end());
  const Vec2 at = instant_at(scene, run.trajectory, 0.2).place(mesh->at);
  EXPECT_NEAR(at[0], 0.020, 1e-5);
  EXPECT_NEAR(at[1], 0, 1e-5);
  EXPECT_EQ(count_shapes(scene, Paint::kPitch), 3u);
}

// A blade is tangent to the markers at its clamps; if bent only slightly, it is as long as when unloaded.
TEST(Scene, BladesAreCurvesBetweenTheirClamps) {
  const auto [model, run] = sketch_of_mechanism("parallel_spring_stage", 0.3);
  const Scene scene = make_scene(model, run.trajectory);
  ASSERT_EQ(scene.connectors.size(), 2u);
  const Instant instant = instant_at(scene, run.trajectory, 0.3);
  for (const Connector& blade : scene.connectors) {
    EXPECT_EQ(blade.paint, Paint::kBlade);
    const std::vector<Vec2> curve = cubic_curve(instant.place(blade.from), blade.length * instant.along(blade.from), instant.place(blade.to), blade.length * instant.along(blade.to));
    EXPECT_LT(length(curve.back() - instant.place(blade.to)), 1e-12);
    EXPECT_LT(length(unit(curve[1] - curve[0]) - Vec2{0, -1}), 0.05);
    double total = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) total += length(curve[i] - curve[i - 1]);
    EXPECT_NEAR(total, 0.1, 2e-5);
  }
  const auto pivot = sketch_of_mechanism("cross_spring_pendulum", 4);
  EXPECT_EQ(make_scene(pivot.model, pivot.run.trajectory).connectors.size(), 2u);
}

TEST(Scene, SpringsRodsAndRopesAreConnectors) {
  const auto andrews = run_of_mechanism("andrews");
  const Scene squeezer = make_scene(andrews.model, andrews.run.trajectory);
  ASSERT_EQ(squeezer.connectors.size(), 1u);
  EXPECT_EQ(squeezer.connectors[0].paint, Paint::kSpring);
  EXPECT_EQ(std::count_if(squeezer.labels.begin(), squeezer.labels.end(), [](const NamedPoint& l) { return l.name == "E3, E4, E6"; }), 1);
  const auto crane = run_of_mechanism("rope_pendulum");
  const Scene pendulum = make_scene(crane.model, crane.run.trajectory);
  ASSERT_EQ(pendulum.connectors.size(), 2u);
  EXPECT_EQ(pendulum.connectors[0].paint, Paint::kRope);
  EXPECT_EQ(pendulum.connectors[1].paint, Paint::kRod);
}

TEST(Scene, AppliedForcesAreDrawnAsTheyAct) {
  const Model model = parse_model(R"toml(
format = 1
[simulate]
duration = "1 s"
output_step = "0.1 s"
[ground.markers]
O = [0, 0]
[body.rod]
mass = 1
inertia = 0.1
angle = "-30 deg"
markers = { A = [-0.5, 0], B = [0.5, 0] }
[joint.A]
type = "revolute"
between = ["ground.O", "rod.A"]
[force.push]
on = "rod.B"
axes = "body"
force = [3, "4 N*t/1 s"]
[force.drag]
on = "rod.B"
force = ["-2 N*s/m*rod.B.vx", 0]
)toml", "loads.toml");
  const Trajectory run = simulate(model);
  const Scene scene = make_scene(model, run);
  ASSERT_EQ(scene.loads.size(), 2u);
  const auto at = [&](std::size_t row, const char* name) { return run.at(row, static_cast<std::size_t>(run.column(name))); };
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double t = run.at(row, 0), a = at(row, "body.rod.angle");
    const std::vector<Vec2> forces = instant_at(scene, run, t).loads;
    EXPECT_NEAR(forces[0][0], 3 * std::cos(a) - 4 * t * std::sin(a), 1e-12);
    EXPECT_NEAR(forces[0][1], 3 * std::sin(a) + 4 * t * std::cos(a), 1e-12);
    EXPECT_NEAR(forces[1][0], -2 * (at(row, "body.rod.vx") - 0.5 * std::sin(a) * at(row, "body.rod.spin")), 1e-12);
  }
  EXPECT_LT(std::abs(instant_at(scene, run, 0).loads[1][0]), 1e-5);
  EXPECT_GT(std::abs(instant_at(scene, run, 0.5).loads[1][0]), 0.1);
}

TEST(Scene, WhatWasNotRecordedIsNotDrawn) {
  auto [model, run] = run_of_mechanism("four_bar");
  model.simulate.record = {"body.crank", "joint.*"};
  const Trajectory trajectory = simulate(model);
  const Scene scene = make_scene(model, trajectory);
  EXPECT_EQ(scene.n_unseen, 2u);
  EXPECT_EQ(count_shapes(scene, Paint::kLink), 1u);
  for (const Shape& shape : scene.shapes) EXPECT_LE(shape.body, 0);
}

TEST(Scene, RunWithoutRowsIsEmpty) {
  const auto [model, run] = run_of_mechanism("pendulum");
  EXPECT_TRUE(make_scene(model, Trajectory()).shapes.empty());
}

TEST(Scene, OtherSpacesAreRefused) {
  auto [model, run] = run_of_mechanism("pendulum");
  model.space = "spatial";
  EXPECT_THROW(make_scene(model, run.trajectory), std::invalid_argument);
}

}  // namespace
}  // namespace pintle
