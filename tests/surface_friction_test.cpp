// Curved surfaces that rub: cams and edges against closed forms and against straight ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "pintle/check.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::completed;
using reference::value;

// A disc of 2 kg and 50 mm on the surface of a joint of `keys`; released at `position`.
Model disc_on(const std::string& keys, const std::string& simulate, const std::string& position, double inertia, const std::string& motion = "velocity = [0, 0]\nspin = 0") {
  return parse_model(fmt::format(R"toml(
format = 1
[simulate]
output_step = "1 ms"
tolerance = 1e-6
{}
[ground.markers]
O = [0, 0]
[body.disc]
mass = 2
inertia = {:.17g}
position = {}
angle = 0
{}
markers.c = [0, 0]
[joint.J]
between = ["ground.O", "disc.c"]
law = "contact"
contact_model = "linear"
contact_stiffness = 1e8
contact_damping = 1e4
contact_exponent = 1
{}
)toml",
                                 simulate, inertia, position, motion, keys),
                     "disc.toml");
}

constexpr double kDisc = 0.5 * 2 * 0.05 * 0.05;
constexpr const char* kRough = "friction_coefficient = 0.3\nstatic_friction = 0.4\n";

// An edge of zero height is the same as a pin's straight one: a disc is set onto it, slides and then rolls.
TEST(EdgeContact, OfAFlatEdgeIsThatOfAStraightOne) {
  const std::string simulate = "duration = \"0.4 s\"", motion = "velocity = [\"1.5 m/s\", 0]\nspin = \"-2 rad/s\"";
  const Trajectory curved = completed(disc_on(std::string("type = \"edge\"\nheight = 0\nfrom = -1\nto = 1\nroller_radius = 0.05\n") + kRough, simulate, "[0, 0.049999]", kDisc, motion));
  const Trajectory straight = completed(disc_on(std::string("type = \"slot\"\npin_radius = 0.05\n") + kRough, simulate, "[0, 0.049999]", kDisc, motion));
  ASSERT_EQ(curved.n_rows(), straight.n_rows());
  double largest = 0;
  for (std::size_t i = 0; i < curved.n_rows(); ++i)
    for (const char* name : {"joint.J.on_disc.fx[world]", "joint.J.on_disc.fy[world]"}) {
      largest = std::max(largest, std::abs(value(straight, i, name)));
      EXPECT_NEAR(value(curved, i, name), value(straight, i, name), 1e-3) << name << " at " << value(curved, i, "t");
    }
  EXPECT_GT(largest, 19.6);
  const std::size_t end = curved.n_rows() - 1;
  EXPECT_EQ(value(curved, end, "joint.J.stuck"), 1);
  EXPECT_NEAR(value(curved, end, "body.disc.vx"), -0.05 * value(curved, end, "body.disc.spin"), 1e-6);
  EXPECT_NEAR(value(curved, end, "joint.J.contact_x"), value(curved, end, "body.disc.x"), 1e-9);
}

// A disc rolls down a fixed cylinder of 0.4 m from 10 degrees off its top: energy gives its speed, the speed the forces, and these the angle at which it
// begins to slip.
void expect_rolling_down_a_cylinder(const std::string& surface) {
  constexpr double kRadius = 0.45, kFirst = 0.17453292519943295, kMass = 2;
  const Trajectory run = completed(disc_on(surface + kRough, "duration = \"0.6 s\"", fmt::format("[{:.17g}, {:.17g}]", kRadius * std::sin(kFirst), kRadius * std::cos(kFirst)), kDisc));
  double slips_at = 0;
  int rows = 0;
  for (std::size_t i = 50; i < run.n_rows() && slips_at == 0; ++i) {  // at first the spring of surfaces that stick takes up its load
    const double angle = std::atan2(value(run, i, "body.disc.x"), value(run, i, "body.disc.y"));
    if (value(run, i, "joint.J.stuck") == 0) {
      slips_at = angle;
      break;
    }
    const double centripetal = 4.0 / 3 * kStandardGravity * (std::cos(kFirst) - std::cos(angle)), normal = kMass * (kStandardGravity * std::cos(angle) - centripetal), friction = kMass * kStandardGravity * std::sin(angle) / 3;
    ++rows;
    EXPECT_NEAR(value(run, i, "joint.J.contact_force"), normal, 2e-3) << angle;
    EXPECT_NEAR(value(run, i, "joint.J.on_disc.m[world]"), -friction * 0.05, 2e-3 * 0.05) << angle;
  }
  EXPECT_GT(rows, 100);
  // sin(a)/3 = 0.4 (cos a - 4/3 (cos a0 - cos a))
  double low = 0.3, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double a = 0.5 * (low + high);
    (std::sin(a) / 3 < 0.4 * (std::cos(a) - 4.0 / 3 * (std::cos(kFirst) - std::cos(a))) ? low : high) = a;
  }
  EXPECT_NEAR(slips_at, low, 5e-3);  // the row after it
}

TEST(EdgeContact, ADiscRollsDownAHillUntilItSlips) {
  expect_rolling_down_a_cylinder("type = \"edge\"\nheight = \"sqrt(0.16 m^2 - x^2)\"\nfrom = -0.35\nto = 0.35\nroller_radius = 0.05\n");
}
TEST(CamContact, ADiscRollsDownACamUntilItSlips) {
  expect_rolling_down_a_cylinder("type = \"cam\"\nlift = 0\nbase_radius = 0.4\nroller_radius = 0.05\n");
}

// A wheel in a round hollow of 0.5 m swings with the period of a rolling pendulum: w^2 = 2 g/(3 (R - r)) for small swings, here 1 degree.
TEST(EdgeContact, ADiscRollsToAndFroInAHollow) {
  constexpr double kArm = 0.45, kSwing = 0.017453292519943295;
  const Trajectory run = completed(disc_on(std::string("type = \"edge\"\nheight = \"0.5 m - sqrt(0.25 m^2 - x^2)\"\nfrom = -0.3\nto = 0.3\nroller_radius = 0.05\n") + kRough, "duration = \"3 s\"",
                                           fmt::format("[{:.17g}, {:.17g}]", kArm * std::sin(kSwing), 0.5 - kArm * std::cos(kSwing)), kDisc));
  const double w = std::sqrt(2 * kStandardGravity / (3 * kArm)), slower = 1 - kSwing * kSwing / 16;  // period of a pendulum, to second order
  for (std::size_t i = 0; i < run.n_rows(); i += 100) {
    const double t = value(run, i, "t");
    EXPECT_NEAR(value(run, i, "body.disc.x"), kArm * std::sin(kSwing * std::cos(w * slower * t)), 2e-6) << t;
  }
}

// A flat face on an eccentric circle that turns: its guide carries the friction, the shaft the moment of the friction about its axis.
struct Solver {
  const char *name, *simulate;
  double tolerance;
};
class FlatFollower : public testing::TestWithParam<Solver> {};

TEST_P(FlatFollower, DragsItsFollowerAlong) {
  constexpr double kSpeed = 20, kFriction = 0.15;
  const Trajectory run = completed(parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "0.6 s"
output_step = "2 ms"
tolerance = {:g}
{}
[ground.markers]
O = [0, 0]
guide = [0, 0, "90 deg"]
[body.cam]
mass = 5
inertia = 1
position = [0, 0]
angle = 0
spin = {}
hold = ["angle"]
markers.O = [0, 0]
[body.follower]
mass = 2
inertia = 0.01
position = [0, "50 mm"]
angle = 0
markers.stem = [0, 0, "90 deg"]
markers.foot = [0, 0]
[joint.O]
type = "revolute"
between = ["ground.O", "cam.O"]
[joint.guide]
type = "prismatic"
between = ["ground.guide", "follower.stem"]
[joint.J]
type = "cam"
between = ["cam.O", "follower.foot"]
base_radius = "40 mm"
follower = "flat"
lift = "10 mm*cos(angle)"
law = "contact"
contact_stiffness = 1e9
contact_exponent = 1
restitution = 0.5
friction_coefficient = {}
[motor.drive]
joint = "O"
speed = {}
)toml",
                                                           GetParam().tolerance, GetParam().simulate, -kSpeed, kFriction, -kSpeed),
                                               "flat.toml"));
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const double t = value(run, i, "t"), turned = -kSpeed * t, normal = value(run, i, "joint.J.contact_force");
    if (t < 0.05) continue;
    // The circle's centre is 10 mm from the axis; the face lies on its highest point.
    const double x = 0.01 * std::cos(turned), y = value(run, i, "body.follower.y");
    EXPECT_NEAR(value(run, i, "joint.J.on_follower.fx[world]"), kFriction * normal, 10 * GetParam().tolerance * normal) << t;  // the cam turns clockwise
    EXPECT_NEAR(value(run, i, "joint.J.slip"), -kSpeed * y, 100 * GetParam().tolerance) << t;
    EXPECT_NEAR(value(run, i, "joint.J.on_cam.m[world]"), -x * normal + y * kFriction * normal, 20 * GetParam().tolerance * normal) << t;
    EXPECT_NEAR(value(run, i, "joint.J.wear_power"), normal * kSpeed * y, 200 * GetParam().tolerance * normal) << t;
  }
}
INSTANTIATE_TEST_SUITE_P(Equations, FlatFollower, testing::Values(Solver{"Radau", "", 1e-6}, Solver{"RelativeRadau", "equations = \"relative\"", 1e-6}, Solver{"Dopri5", "method = \"dopri5\"", 1e-4},
                                         Solver{"RelativeDopri5", "equations = \"relative\"\nmethod = \"dopri5\"", 1e-4}, Solver{"Ode15s", "method = \"ode15s\"", 1e-5}),
                         [](const auto& of) { return std::string(of.param.name); });

// A friction law of the catalog in a grooved cam, pressed by the cam's own force.
TEST(CamFriction, IsTheCoefficientTimesTheForceOfTheGroove) {
  Model model = reference::mechanism("cam_follower", {"simulate.duration=0.15 s"});
  Joint& cam = *std::find_if(model.joints.begin(), model.joints.end(), [](const Joint& joint) { return joint.name == "cam"; });
  cam.law = {"linear", {{"stiffness", {2e8}}, {"damping", {1e4}}}};
  cam.friction = {"stribeck", {{"friction_coefficient", {0.08}}, {"static_friction", {0.08}}}};
  const Trajectory run = completed(model);
  double most = 0;
  for (std::size_t i = 20; i < run.n_rows(); ++i) {
    const double friction = value(run, i, "joint.cam.friction"), f1 = value(run, i, "joint.cam.on_follower.fx[world]"), f2 = value(run, i, "joint.cam.on_follower.fy[world]");
    const double whole = std::hypot(f1, f2), across = std::sqrt(whole * whole - friction * friction);
    most = std::max(most, std::abs(friction));
    EXPECT_NEAR(std::abs(friction), 0.08 * across, 1e-5 * across) << i;
  }
  EXPECT_GT(most, 5);
}

TEST(SurfaceSlip, PassesTheChecks) {
  for (const char* surface : {"type = \"cam\"\nlift = \"0.02 m*cos(2*angle)\"\nbase_radius = 0.4\nroller_radius = 0.05\n",
                              "type = \"edge\"\nheight = \"0.02 m*sin(x/0.1 m)\"\nfrom = -0.35\nto = 0.35\nroller_radius = 0.02\n"}) {
    const CheckReport report = check_model(disc_on(std::string(surface) + kRough, "duration = \"0.1 s\"", "[0.1, 0.47]", kDisc, "velocity = [0.3, -0.1]\nspin = 2"));
    for (const CheckBattery* battery : {&report.jacobians, &report.energy})
      for (const CheckItem& item : battery->items) EXPECT_TRUE(item.passed()) << item.what << " " << item.worst << " at " << item.place;
  }
}

}  // namespace
}  // namespace pintle
