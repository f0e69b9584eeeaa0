// Cams in whole mechanisms, against closed forms: an eccentric circle is a rod, a flat face on it moves by a cosine; a spring loses its
// follower at the speed of the force balance; a cycloidal rise has its accelerations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

// A cam on a pin, turned clockwise at constant speed, and a follower that slides above it.
std::string turning_cam(const std::string& joint, double speed, double mass, const std::string& rest) {
  return R"toml(
format = 1
name = "Cam"
[simulate]
duration = ")toml" + std::to_string(2 * kTurn / speed) + R"toml( s"
output_step = ")toml" + std::to_string(kTurn / speed / 200) + R"toml( s"
tolerance = 1e-6
[ground.markers]
O = [0, 0]
guide = [0, 0, "90 deg"]
seat = [0, "1 m"]
[body.cam]
mass = "5 kg"
inertia = "1 kg*m^2"
position = [0, 0]
angle = 0
spin = -)toml" + std::to_string(speed) + R"toml(
hold = ["angle"]
markers.O = [0, 0, "90 deg"]
markers.E = [0, "10 mm"]
[body.follower]
mass = )toml" + std::to_string(mass) + R"toml(
inertia = 0.01
position = [0, "60 mm"]
angle = 0
markers.stem = [0, 0, "90 deg"]
markers.foot = [0, 0]
[joint.O]
type = "revolute"
between = ["ground.O", "cam.O"]
[joint.guide]
type = "prismatic"
between = ["ground.guide", "follower.stem"]
[motor.drive]
joint = "O"
speed = -)toml" + std::to_string(speed) + "\n" + joint + rest;
}

std::vector<double> column(const Trajectory& run, const std::string& name) {
  const int c = run.column(name);
  EXPECT_GE(c, 0) << name;
  std::vector<double> out;
  for (std::size_t i = 0; i < run.n_rows() && c >= 0; ++i) out.push_back(run.at(i, static_cast<std::size_t>(c)));
  return out;
}

// The pitch curve of a circle of 40 mm that is 10 mm off the axis, with a roller of 12 mm, is a circle of 52 mm: the distance is that of a rod's ends.
TEST(Cams, AnEccentricCircleIsARod) {
  const std::string law = "stiffness = \"1e7 N/m\"\ndamping = \"2e3 N*s/m\"\n";
  const std::string cam = "[joint.J]\ntype = \"cam\"\nbetween = [\"cam.O\", \"follower.foot\"]\nbase_radius = \"40 mm\"\nroller_radius = \"12 mm\"\nlift = \"10 mm*cos(angle) + sqrt((52 mm)^2 - (10 mm*sin(angle))^2) - 52 mm\"\nlaw = \"linear\"\n" + law;
  const std::string rod = "[joint.J]\ntype = \"rod\"\nlength = \"52 mm\"\nbetween = [\"cam.E\", \"follower.foot\"]\n" + law;
  const Trajectory a = simulate(parse_model(turning_cam(cam, 30, 2, ""), "a.toml")), b = simulate(parse_model(turning_cam(rod, 30, 2, ""), "b.toml"));
  ASSERT_EQ(a.outcome, Outcome::kCompleted) << a.message;
  ASSERT_EQ(b.outcome, Outcome::kCompleted) << b.message;
  for (const char* name : {"joint.J.on_follower.fx[world]", "joint.J.on_follower.fy[world]", "joint.guide.on_follower.fx[world]"}) {
    const std::vector<double> x = column(a, name), y = column(b, name);
    ASSERT_EQ(x.size(), y.size());
    double peak = 0;
    for (const double one : y) peak = std::max(peak, std::abs(one));
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 5e-6 * peak) << name << " row " << i;
  }
  // The pressure angle is that of the rod, except for the deflection of the joints.
  const std::vector<double> angle = column(a, "joint.J.pressure_angle"), turned = column(a, "body.cam.angle"), side = column(a, "joint.J.on_follower.fx[world]"), up = column(a, "joint.J.on_follower.fy[world]");
  for (std::size_t i = 0; i < angle.size(); ++i) {
    EXPECT_NEAR(angle[i], -std::asin(10 * std::sin(turned[i]) / 52), 2e-5);
    EXPECT_NEAR(side[i], -up[i] * std::tan(angle[i]), 1e-9 * (1 + std::abs(up[i])));
  }
}

// A flat face on the same circle: y = 40 mm + 10 mm cos(w t), whatever the speed.
TEST(Cams, AFlatFaceOnAnEccentricCircleMovesByACosine) {
  const double w = 25, mass = 2;
  const std::string joint = "[joint.J]\ntype = \"cam\"\nbetween = [\"cam.O\", \"follower.foot\"]\nbase_radius = \"40 mm\"\nfollower = \"flat\"\nlift = \"10 mm*cos(angle)\"\nlaw = \"contact\"\ncontact_stiffness = 1e10\ncontact_exponent = 1\nrestitution = 0.5\n";
  const Trajectory run = simulate(parse_model(turning_cam(joint, w, mass, ""), "flat.toml"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const std::vector<double> t = column(run, "t"), y = column(run, "body.follower.y"), force = column(run, "joint.J.contact_force"), on_cam = column(run, "joint.J.on_cam.m[world]"),
                            on_face = column(run, "joint.J.on_follower.m[world]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    EXPECT_NEAR(y[i], 0.04 + 0.01 * std::cos(w * t[i]), 1e-6) << t[i];
    EXPECT_NEAR(force[i], mass * (kStandardGravity - 0.01 * w * w * std::cos(w * t[i])), 0.01) << t[i];
    // The face touches above the centre of the circle, where the force has this lever about the cam's axis.
    EXPECT_NEAR(on_cam[i], -0.01 * std::sin(w * t[i]) * force[i], 1e-4) << t[i];
    EXPECT_NEAR(on_face[i], 0.01 * std::sin(w * t[i]) * force[i], 1e-4) << t[i];
  }
}

// lift = h/2 (1 - cos(angle)) under a spring: the least of m g + F + k s + m s'' w^2 over m |s''|, at the top.
TEST(Cams, ASpringLosesItsFollowerAtTheSpeedOfTheForceBalance) {
  const double mass = 0.8, preload = 100, stiffness = 4000, lift = 0.02;
  const double critical = std::sqrt((mass * kStandardGravity + preload + stiffness * lift) / (mass * lift / 2));
  const auto run_at = [&](double speed) {
    const std::string joint = "[joint.J]\ntype = \"cam\"\nbetween = [\"cam.O\", \"follower.foot\"]\nbase_radius = \"60 mm\"\nfollower = \"flat\"\nlift = \"10 mm*(1 - cos(angle))\"\nlaw = \"contact\"\ncontact_stiffness = 1e9\ncontact_exponent = 1\nrestitution = 0.5\n";
    const std::string spring = "[spring.S]\nbetween = [\"ground.seat\", \"follower.foot\"]\nstiffness = 4000\npreload = -100\n";
    return simulate(parse_model(turning_cam(joint, speed, mass, spring), "spring.toml"));
  };
  const Trajectory on = run_at(0.99 * critical), off = run_at(1.02 * critical);
  ASSERT_EQ(on.outcome, Outcome::kCompleted) << on.message;
  ASSERT_EQ(off.outcome, Outcome::kCompleted) << off.message;
  const std::vector<double> pressed = column(on, "joint.J.contact_force"), lost = column(off, "joint.J.contact_force"), depth = column(off, "joint.J.penetration");
  EXPECT_GT(*std::min_element(pressed.begin(), pressed.end()), 0);
  EXPECT_NEAR(*std::min_element(pressed.begin(), pressed.end()), (1 - 0.99 * 0.99) * (mass * kStandardGravity + preload + stiffness * lift), 0.2);
  EXPECT_EQ(*std::min_element(lost.begin(), lost.end()), 0);
  EXPECT_LT(*std::min_element(depth.begin(), depth.end()), 0);
}

// The cam of the collection: s = h (x - sin(2 pi x)/(2 pi)) with x = angle over 90 degrees; s'' = 2 pi h sin(2 pi x) over its square.
TEST(Cams, ACycloidalRiseHasItsAccelerations) {
  Model model = reference::mechanism("cam_follower", {"simulate.duration=0.17 s"});
  model.simulate.tolerance = 1e-6;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const double w = 360 * kTurn / 60, mass = 0.8, rise = 0.02, up = kTurn / 4;
  const std::vector<double> t = column(run, "t"), y = column(run, "body.follower.y"), force = column(run, "joint.cam.on_follower.fy[world]");
  double most = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double x = (w * t[i] - kTurn / 12) / up;  // the cam begins 30 degrees before the rise
    if (x < 0 || x >= 1) continue;
    const double s = rise * (x - std::sin(kTurn * x) / kTurn), acceleration = kTurn * rise * std::sin(kTurn * x) / (up * up) * w * w;
    EXPECT_NEAR(y[i], 0.092 + s, 1e-5) << t[i];  // the joints deflect by micrometres
    EXPECT_NEAR(force[i], mass * (kStandardGravity + acceleration) + 150 + 8000 * s, 2) << t[i];
    most = std::max(most, acceleration);
  }
  EXPECT_NEAR(most, kTurn * rise / (up * up) * w * w, 0.1);
}

// Whatever the force is after the touch at which a step ends.
TEST(Cams, RowsOfAnOpenContactShowNoForce) {
  const Trajectory run = reference::completed(reference::test_model("lift_off_cam"));
  int open = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    if (!(reference::value(run, row, "joint.cam.penetration") < 0)) continue;
    ++open;
    EXPECT_EQ(std::hypot(reference::value(run, row, "joint.cam.on_lever.fx[world]"), reference::value(run, row, "joint.cam.on_lever.fy[world]")), 0) << run.at(row, 0);
  }
  EXPECT_GT(open, 100);
}

// A particle that leaves a dome flies on to where the height of the dome is the root of a negative number.
TEST(Cams, AnEdgeThatHasNoHeightBesideItsStretchIsNamed) {
  const Trajectory run = simulate(parse_model(R"toml(format = 1
[simulate]
duration = "1 s"
[ground.markers]
o = [0, 0]
[body.p]
mass = 1
inertia = 1e-3
position = [0, 1]
velocity = [0.5, 0]
markers.c = [0, 0]
[joint.dome]
type = "edge"
between = ["ground.o", "p.c"]
height = "sqrt((1 m)^2 - x^2)"
from = -0.9
to = 0.9
law = "contact"
contact_stiffness = 1e8
contact_exponent = 1
restitution = 0.2
)toml", "dome"));
  EXPECT_EQ(run.outcome, Outcome::kFailed);
  EXPECT_NE(run.message.find("joint dome (no solution found), whose edge has no finite height"), std::string::npos) << run.message;
  EXPECT_NE(run.message.find("whose edge has no finite height at x = 1"), std::string::npos) << run.message;
}

TEST(Edges, ARollerThatLeavesItsEdgeIsNoted) {
  const auto noted = [](const std::vector<std::string>& overrides, const std::string& text) {
    const Trajectory run = reference::completed(reference::mechanism("wheel_over_bump", overrides));
    return std::any_of(run.notes.begin(), run.notes.end(), [&text](const std::string& note) { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(noted({"joint.road.to=\"2 m\""}, "s on it runs beyond its edge (to = 2 m)"));
  EXPECT_FALSE(noted({}, "runs beyond its edge"));
}

}  // namespace
}  // namespace pintle
