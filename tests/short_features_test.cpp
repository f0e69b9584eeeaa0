// Short features are seen, however long the steps are that lead to them: blows, notches, bumps, fields of force, and the vibrations that a kink leaves behind.
// theory/time section 3.4.
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

Model hanging_rod(const std::string& blow, const std::string& more = "") {
  return parse_model(R"toml(
format = 1
[simulate]
duration = "6 s"
[ground.markers]
O = [0, 0]
[body.rod]
mass = "2 kg"
inertia = "2 kg*(1 m)^2/12"
angle = "-90 deg"
spin = 0
markers.O = ["-0.5 m", 0]
markers.tip = ["0.5 m", 0]
[joint.O]
type = "revolute"
between = ["ground.O", "rod.O"]
[force.blow]
on = "rod.tip"
force = [")toml" + blow + "\", 0]\n" + more,
                     "rod.toml");
}

std::string sliding_block(const std::string& mass, const std::string& position, const std::string& speed) {
  return R"toml(
format = 1
gravity = [0, 0]
[ground.markers]
rail = [0, 0]
[body.block]
mass = ")toml" + mass + "\"\ninertia = \"0.01 kg*m^2\"\nposition = [" + position + "]\nvelocity = [\"" + speed + "\", 0]\n" + R"toml(angle = 0
hold = ["x"]
markers.c = [0, 0]
[joint.rail]
type = "prismatic"
between = ["ground.rail", "block.c"]
)toml";
}

Model over_a_notch() {
  return parse_model(sliding_block("3 kg", "\"-100 mm\", 0", "1.5 m/s") + R"toml(
detent = "ball-detent"
ball_radius = "4 mm"
notch_radius = "6 mm"
notch_width = "7 mm"
detent_preload = "40 N"
detent_rate = "5 N/mm"
detent_at = "200 mm"
[simulate]
duration = "1 s"
)toml",
                     "notch.toml");
}

Model through_a_field() {
  return parse_model(sliding_block("1 kg", "0, 0", "5 m/s") + R"toml(
[force.field]
on = "block.c"
force = [0, "500 N*exp(-((block.x - 10.3 m)/(20 mm))^2)"]
[simulate]
duration = "4 s"
)toml",
                     "field.toml");
}

Model over_a_lip() {
  return parse_model(R"toml(
format = 1
[simulate]
duration = "1 s"
[ground.markers]
o = [0, 0]
[body.trolley]
mass = "2 kg"
inertia = "0.01 kg*m^2"
position = [0, "20 mm"]
velocity = ["1.5 m/s", 0]
angle = 0
spin = 0
hold = ["x"]
markers.c = [0, 0]
[joint.edge]
type = "edge"
between = ["ground.o", "trolley.c"]
height = "0.1 mm*exp(-((x - 0.7 m)/(6 mm))^2)"
roller_radius = "20 mm"
from = 0
to = "1.5 m"
law = "contact"
contact_stiffness = 1e7
contact_exponent = 1
restitution = 0.5
)toml",
                     "lip.toml");
}

// A cam of constant speed that lifts within 4 of 360 degrees and dwells for the rest, against a spring that holds its follower on it.
Model cam_that_rests() {
  return parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "10 s"
[ground.markers]
O = [0, 0]
way = [0, "200 mm", "90 deg"]
[body.cam]
mass = "3 kg"
inertia = "5e-3 kg*m^2"
position = [0, 0]
angle = 0
spin = "1 rad/s"
hold = ["angle"]
markers.O = [0, 0]
[body.pusher]
mass = "1.5 kg"
inertia = "2e-3 kg*m^2"
position = [0, "106 mm"]
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
lift = "0.2 mm*exp(-((angle - 200 deg)/(2 deg))^2)"
[motor.drive]
joint = "O"
speed = "1 rad/s"
[spring.s]
between = ["ground.way", "pusher.c"]
stiffness = "10 N/mm"
free_length = "150 mm"
)toml",
                     "cam.toml");
}

double largest_peak(const Trajectory& run) {
  double peak = 0;
  for (const LoadSummary& joint : run.joints) peak = std::max(peak, joint.peak);
  return peak;
}

// The result at any tolerance is that of steps too short to miss the feature.
void expect_seen(Model model, double longest_step) {
  model.simulate.max_step = longest_step;
  model.simulate.tolerance = 1e-7;
  const Trajectory close = reference::completed(model);
  model.simulate.max_step = 0;
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    ASSERT_EQ(run.joints.size(), close.joints.size());
    for (std::size_t j = 0; j < run.joints.size(); ++j)
      EXPECT_NEAR(run.joints[j].peak, close.joints[j].peak, std::max(tolerance, 2e-7) * largest_peak(close)) << model.name << ", joint " << run.joints[j].name << " at " << tolerance;
  }
}

// theory/contact section 8: the force of the ball on the edge of its notch.
TEST(ShortFeatures, ASlideIsHeldByTheNotchThatItPasses) {
  const double edge = std::asin(3.5 / 6), lift = 2e-3 * (1 - std::cos(edge)), force = (40 + 5e3 * lift) * std::tan(edge);
  for (const double tolerance : {1e-3, 1e-5, 1e-9}) {
    Model model = over_a_notch();
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_NEAR(run.joints[0].peak, force, 1e-3 * force) << tolerance;
    EXPECT_LT(std::abs(reference::drift(run)), 1e-6) << tolerance;
  }
}

// An impulse of J = 200 N 5 ms sqrt(pi) at the end of a hanging rod.
TEST(ShortFeatures, ABlowMovesWhatHasHungStill) {
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    Model model = hanging_rod("200 N*exp(-((t - 3 s)/(5 ms))^2)");
    model.simulate.tolerance = tolerance;
    model.simulate.duration = 3.02;
    const Trajectory run = reference::completed(model);
    const double spin = 200 * 5e-3 * std::sqrt(kTurn / 2) / (2.0 / 3);
    EXPECT_NEAR(reference::at_end(run, "body.rod.spin"), spin, 4e-3 * spin) << tolerance;  // it has turned by 3 degrees
  }
}

TEST(ShortFeatures, ABlowFromATableOrAMotorIsSeen) {
  expect_seen(hanging_rod("200 N*exp(-((t - 3 s)/(5 ms))^2)"), 1e-3);
  expect_seen(hanging_rod("blow(t)", R"toml(
[table.blow]
x = ["0 s", "2.99 s", "3 s", "3.01 s", "6 s"]
y = ["0 N", "0 N", "200 N", "0 N", "0 N"]
interpolation = "monotone"
)toml"), 1e-3);
  expect_seen(hanging_rod("0 N", R"toml(
[motor.kick]
joint = "O"
torque = "200 N*m*exp(-((t - 3 s)/(5 ms))^2)"
)toml"), 1e-3);
  expect_seen(hanging_rod("0 N", R"toml(
[motor.turn]
joint = "O"
position = "20 deg*(1 + tanh((t - 3.3 s)/(20 ms)))"
)toml"), 2e-3);
}

TEST(ShortFeatures, AFieldOfForceIsSeen) { expect_seen(through_a_field(), 5e-4); }
// A balanced rotor turns four times, and nothing accelerates it: its steps are as long as whole turns. In each turn a point on it passes a field 25 ms wide, which pushes the rotor at its
// centre.
TEST(ShortFeatures, AFieldThatAMarkerPassesInEveryTurnIsSeen) {
  for (const char* spin : {"25.05", "25.09", "25.138", "25.2"})
    for (const char* method : {"radau", "dopri5"}) {
      Model model = parse_model(R"toml(
format = 1
name = "Rotor in a field"
gravity = [0, 0]
[simulate]
duration = "1 s"
output_step = "1 ms"
[ground.markers]
O = [0, 0]
[body.a]
mass = 1
inertia = 0.01
position = [0, 0]
angle = -1.3
hold = ["angle"]
markers.o = [0, 0]
markers.p = [0.1, 0]
[joint.o]
type = "revolute"
between = ["ground.O", "a.o"]
[force.f]
on = "a.o"
force = [0, "100 + 20*exp(-((a.p.x - 0.1)/0.003)^2)"]
)toml", "rotor.toml", {"body.a.spin=" + std::string(spin)});
      model.simulate.method = method;
      const Trajectory run = reference::completed(model);
      double worst = 0;
      for (std::size_t row = 0; row < run.n_rows(); ++row) {
        const double x = 0.1 * std::cos(reference::value(run, row, "body.a.angle"));
        worst = std::max(worst, std::abs(std::abs(reference::value(run, row, "joint.o.on_a.fy[world]")) - 100 - 20 * std::exp(-std::pow((x - 0.1) / 0.003, 2))));
      }
      EXPECT_LT(worst, 1e-4 * 120) << spin << ", " << method;  // the pin deflects by a micrometre, of the 3 mm of the field
      EXPECT_LT(run.counters.steps + run.counters.rejected, method == std::string("radau") ? 5000u : 50000u) << spin << ", " << method;
    }
}

TEST(ShortFeatures, AnEdgesBumpIsSeen) { expect_seen(over_a_lip(), 2e-4); }
TEST(ShortFeatures, ACamsLiftIsSeen) { expect_seen(cam_that_rests(), 2e-3); }

// A load that begins to grow leaves a vibration of slope / omega in a joint without damping. Steps that are long compared with its period would damp it equally in all
// passes.
TEST(ShortFeatures, AKinkLeavesAVibrationBehind) {
  constexpr double kLoad = 50, kSlope = 2000, kKink = 0.1, kPinStiffness = 1e8;
  const Model base = parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
duration = "0.2 s"
output_step = "0.1 ms"
[ground.markers]
O = [0, 0]
[body.b]
mass = "1 kg"
inertia = "1 kg*m^2"
position = [0, 0]
angle = 0
spin = 0
markers.O = [0, 0]
[joint.O]
type = "revolute"
between = ["ground.O", "b.O"]
stiffness = "1e8 N/m"
damping = 0
[force.f]
on = "b.O"
force = ["50 N + 2000 N/s*max(t - 0.1 s, 0 s)", 0]
)toml",
                                 "kink.toml");
  const double omega = std::sqrt(kPinStiffness), peak = kLoad + 0.1 * kSlope;
  for (const char* equations : {"newtonian", "relative"})
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
      Model model = base;
      model.simulate.tolerance = tolerance;
      model.simulate.equations = to_equations(equations);
      const Trajectory run = reference::completed(model);
      double largest = 0;
      for (std::size_t row = 0; row < run.n_rows(); ++row) {
        const double past = std::max(run.at(row, 0) - kKink, 0.0), load = kLoad + kSlope * (past - std::sin(omega * past) / omega);
        largest = std::max(largest, std::abs(-reference::value(run, row, "joint.O.on_b.fx[world]") - load));
      }
      EXPECT_LT(largest, tolerance * peak) << equations << " at " << tolerance;
      EXPECT_LT(largest, 30 * std::max(run.joints[0].error_estimate, 1e-8 * peak)) << equations << " at " << tolerance;
    }
}

// The points of a table are known, however close together they are: a shock in a record of 20 s, and all the pulses of a periodic table.
TEST(ShortFeatures, PointsOfATableOfTime) {
  const auto beam = [](const std::string& table, const std::string& more) {
    return parse_model(R"toml(
format = 1
[table.shock]
)toml" + table + R"toml(
[ground.markers]
p = [0, 0]
[body.beam]
mass = "100 kg"
inertia = "20 kg*m^2"
position = ["0.5 m", 0]
angle = 0
hold = ["angle"]
markers.p = ["-0.5 m", 0]
markers.e = ["0.5 m", 0]
[joint.pin]
type = "revolute"
between = ["ground.p", "beam.p"]
[torsion_spring.s]
between = ["ground.p", "beam.p"]
stiffness = "2e5 N*m/rad"
damping = "500 N*m*s/rad"
[force.f]
on = "beam.e"
force = [0, "shock(t)"]
[simulate]
)toml" + more,
                       "shock.toml");
  };
  const std::string record = "x = [0, 9.1315, 9.134, 9.1365, 20]\nx_unit = \"s\"\ny = [0, 0, 80, 0, 0]\ny_unit = \"kN\"";
  Model once = beam(record, "duration = \"20 s\"");
  const double alone = reference::completed(once).joints.at(0).peak;
  once.simulate.max_step = 1e-3;
  EXPECT_NEAR(alone, reference::completed(once).joints.at(0).peak, 2e-5 * alone);
  EXPECT_GT(alone, 16000);
  const std::string pulses = "x = [0, 0.0299, 0.03, 0.0301, 0.04]\nx_unit = \"s\"\ny = [0, 0, 8, 0, 0]\ny_unit = \"kN\"\nperiod = \"0.04 s\"";
  Model often = beam(pulses, "duration = \"4 s\"");
  const Trajectory run = reference::completed(often);
  often.simulate.duration = 1;
  EXPECT_NEAR(run.joints.at(0).peak, reference::completed(often).joints.at(0).peak, 2e-5 * run.joints.at(0).peak);
  EXPECT_GT(run.joints.at(0).peak, 1400);
}

// A triangle of 20 us and 10 N s, whose flanks are as short as the part crossed at the start of a usual step.
TEST(ShortFeatures, ASpikeOfAMillionthOfARecord) {
  Model model = reference::test_model("spike_in_a_force_record");
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_NEAR(reference::at_end(run, "body.m.vx"), 1.199999, 2e-6) << tolerance;
    EXPECT_NEAR(run.joints.at(0).peak_moment, 1000, 1) << tolerance;
  }
}

// The ends of a smoothstep are known in the same way: a dip of 120 mm in 61.5 m of rail.
TEST(ShortFeatures, PiecesOfAnEdge) {
  Model model = reference::test_model("wheel_over_a_dip");
  EXPECT_NEAR(reference::completed(model).joints.at(2).peak, 578006, 6);
  model.simulate.duration = 2.3;
  EXPECT_NEAR(reference::completed(model).joints.at(2).peak, 578006, 6);
}

}  // namespace
}  // namespace pintle
