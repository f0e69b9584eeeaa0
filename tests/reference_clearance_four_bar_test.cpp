// The paper's four-bar with a clearance joint at B, without and with friction, against computed tables and against independent equations.
//
// The tables take the radii of pin and bush as the lever arms of friction: two points of contact, a depth apart. A joint of Pintle has one (theory/contact
// section 4). The equations below allow both: with two points they give the table, with one they give Pintle's run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/contact_runs.h"

namespace pintle {
namespace {

using contacts::follow;
using contacts::Followed;

constexpr double kCoupler = 0.8956647938578649, kFollower = 2.2459278597319283;  // angles at the start
constexpr double kDuration = 0.3, kOutputStep = 0.005, kFriction = 0.1;
constexpr double kAngleLimit = 1e-7, kForceLimit = 1e-3, kTimeLimit = 1e-7;      // tolerances against the tables

// Rows of t, three angles, force on the coupler; and the times of touch and release, in turn.
struct Motion {
  std::vector<std::array<double, 6>> rows;
  std::vector<double> contacts;
};
struct MotionDifference {
  double angle = 0, force = 0, time = 0;
};
MotionDifference motion_difference(const Motion& a, const Motion& b) {
  MotionDifference most;
  EXPECT_EQ(a.rows.size(), b.rows.size());
  EXPECT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i) {
    EXPECT_NEAR(a.rows[i][0], b.rows[i][0], 1e-12);
    for (int k = 1; k < 4; ++k) most.angle = std::max(most.angle, std::abs(a.rows[i][k] - b.rows[i][k]));
    for (int k = 4; k < 6; ++k) most.force = std::max(most.force, std::abs(a.rows[i][k] - b.rows[i][k]));
  }
  for (std::size_t i = 0; i < std::min(a.contacts.size(), b.contacts.size()); ++i) most.time = std::max(most.time, std::abs(a.contacts[i] - b.contacts[i]));
  return most;
}
void expect_same_motion(const Motion& a, const Motion& b) {
  const MotionDifference most = motion_difference(a, b);
  EXPECT_LT(most.angle, kAngleLimit);
  EXPECT_LT(most.force, kForceLimit);
  EXPECT_LT(most.time, kTimeLimit);
}

// --- Independent equations ---

// Lagrange's equations in the angles of crank, coupler and follower, with the contact force as a load.
class LooseFourBar {
 public:
  enum class Arms { kOnePoint, kTwoPoints };
  LooseFourBar(double friction, Arms arms) : friction_(friction), arms_(arms) {}

  Motion solve() {
    Motion motion;
    Angles y{0, kCoupler, kFollower, 10, -2, -2};
    double t = 0, border = 0;
    for (int row = 0; row <= std::lround(kDuration / kOutputStep); ++row) {
      for (const double end = row * kOutputStep; t < end;) {
        double h = std::min({kStep, 0.2 * (t - border) + 1e-8, end - t});  // short after a border: the force grows with the depth to the power 3/2
        const bool last = h == end - t, crossed = cross(y, h);
        y = stepped(y, h);
        t = last && !crossed ? end : t + h;
        if (!crossed) continue;
        border = t;
        const bool touched = touching_;
        choose_branch(y);
        if (touching_ != touched) motion.contacts.push_back(t);
      }
      const Contact at = contact(y);
      motion.rows.push_back({t, y[0], y[1], y[2], at.fx, at.fy});
    }
    return motion;
  }

 private:
  using Angles = std::array<double, 6>;  // and their rates
  static constexpr double kLink = 4, kGround = 6, kCrankInertia = 1e5 + 0.25, kMass = 4, kMiddle = 2, kInertia = 5.333 + kMass * kMiddle * kMiddle;
  static constexpr double kPin = 0.02, kBush = 0.021, kClearance = 0.001, kStiffness = 1e8, kAlpha = 0.5, kStart = 1e-3, kFull = 1e-2, kStep = 1e-5;
  enum class Ramp { kBelow, kOn, kAbove };

  struct Contact {
    double depth, slip, arm, friction, fx, fy;  // arm of the friction on the follower; force on the coupler
  };
  Contact contact(const Angles& y) const {
    const double x = std::cos(y[0]) + kLink * (std::cos(y[1]) - std::cos(y[2])) - kGround, up = std::sin(y[0]) + kLink * (std::sin(y[1]) - std::sin(y[2]));
    const double vx = -y[3] * std::sin(y[0]) - kLink * (y[4] * std::sin(y[1]) - y[5] * std::sin(y[2]));
    const double vy = y[3] * std::cos(y[0]) + kLink * (y[4] * std::cos(y[1]) - y[5] * std::cos(y[2]));
    const double e = std::max(1e-12, std::hypot(x, up)), nx = x / e, ny = up / e;
    Contact at{};
    at.depth = e - kClearance;
    at.arm = arms_ == Arms::kOnePoint ? e + kPin : kBush;
    at.slip = nx * vy - ny * vx + kPin * y[4] - at.arm * y[5];
    if (!touching_) return at;
    const double normal = kStiffness * std::pow(std::max(0.0, at.depth), 1.5) * (1 + 1.5 * kAlpha * (nx * vx + ny * vy));
    const double share = ramp_ == Ramp::kBelow ? 0 : ramp_ == Ramp::kAbove ? 1 : (std::abs(at.slip) - kStart) / (kFull - kStart);
    at.friction = -friction_ * normal * share * (at.slip > 0 ? 1 : -1);
    at.fx = -normal * nx - at.friction * ny;
    at.fy = -normal * ny + at.friction * nx;
    return at;
  }
  Angles rates(const Angles& y) const {
    const Contact at = contact(y);
    const auto turning = [&at](double angle) { return -at.fx * std::sin(angle) + at.fy * std::cos(angle); };
    const double coupled = kMass * kMiddle * std::cos(y[0] - y[1]), bent = kMass * kMiddle * std::sin(y[0] - y[1]), crank = kCrankInertia + kMass;
    const double crank_moment = turning(y[0]) - bent * y[4] * y[4], coupler_moment = kLink * turning(y[1]) + kPin * at.friction + bent * y[3] * y[3];
    const double determinant = crank * kInertia - coupled * coupled;
    return {y[3], y[4], y[5], (kInertia * crank_moment - coupled * coupler_moment) / determinant, (crank * coupler_moment - coupled * crank_moment) / determinant,
            -(kLink * turning(y[2]) + at.arm * at.friction) / kInertia};
  }
  // Dormand and Prince's method of order 5, on the contact branch that holds at the start of the step.
  Angles stepped(const Angles& y, double h) const {
    static constexpr double kTable[6][6] = {{1.0 / 5},
                                            {3.0 / 40, 9.0 / 40},
                                            {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                            {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                            {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                            {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    std::array<Angles, 6> slope;
    Angles at = y;
    for (int i = 0; i < 6; ++i) {
      slope[i] = rates(at);
      at = y;
      for (int j = 0; j <= i; ++j)
        for (int n = 0; n < 6; ++n) at[n] += h * kTable[i][j] * slope[j][n];
    }
    return at;
  }
  std::array<bool, 3> side(const Angles& y) const {
    const Contact at = contact(y);
    const bool rubs = touching_ && friction_ > 0;
    return {at.depth > 0, rubs && std::abs(at.slip) > kStart, rubs && std::abs(at.slip) > kFull};
  }
  // Shortens a step that crosses a border so that it ends just after it.
  bool cross(const Angles& y, double& h) const {
    const std::array<bool, 3> before = side(y);
    if (side(stepped(y, h)) == before) return false;
    double low = 0, high = h;
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      (side(stepped(y, middle)) == before ? low : high) = middle;
    }
    h = high;
    return true;
  }
  void choose_branch(const Angles& y) {
    const Contact at = contact(y);
    touching_ = at.depth > 0;
    ramp_ = std::abs(at.slip) > kFull ? Ramp::kAbove : std::abs(at.slip) > kStart ? Ramp::kOn : Ramp::kBelow;
  }

  double friction_;
  Arms arms_;
  bool touching_ = false;
  Ramp ramp_ = Ramp::kBelow;
};

// --- The model ---

Model worn_four_bar(double friction) {
  return parse_model(fmt::format(R"toml(
format = 1
gravity = [0, 0]
name = "Four-bar with clearance at B"
[simulate]
duration = {}
output_step = {}
tolerance = 1e-6
equations = "relative"
start = "raw"
[ground.markers]
o2 = {{ x = 0, y = 0 }}
o4 = {{ x = 6, y = 0 }}
[body.crank]
mass = 1
inertia = 1e5
position = [0.5, 0]
angle = 0
velocity = [0, 5]
spin = 10
markers.o2 = {{ x = -0.5, y = 0 }}
markers.a = {{ x = 0.5, y = 0 }}
[body.coupler]
mass = 4
inertia = 5.333
position = [{}, {}]
angle = {}
velocity = [{}, {}]
spin = -2
markers.a = {{ x = -2, y = 0 }}
markers.b = {{ x = 2, y = 0 }}
[body.follower]
mass = 4
inertia = 5.333
position = [{}, {}]
angle = {}
velocity = [{}, {}]
spin = -2
markers.o4 = {{ x = -2, y = 0 }}
markers.b = {{ x = 2, y = 0 }}
[joint.o2]
ideal = true
type = "revolute"
between = ["ground.o2", "crank.o2"]
[joint.a]
ideal = true
type = "revolute"
between = ["crank.a", "coupler.a"]
[joint.b]
type = "revolute"
between = ["follower.b", "coupler.b"]
law = "clearance"
clearance = 0.001
pin_radius = 0.02
contact_stiffness = 1e8
damping_factor = 0.75
friction_coefficient = {}
friction_start_speed = 0.001
friction_full_speed = 0.01
[joint.o4]
ideal = true
type = "revolute"
between = ["ground.o4", "follower.o4"]
)toml",
                                 kDuration, kOutputStep, 1 + 2 * std::cos(kCoupler), 2 * std::sin(kCoupler), kCoupler, 4 * std::sin(kCoupler), 10 - 4 * std::cos(kCoupler),
                                 6 + 2 * std::cos(kFollower), 2 * std::sin(kFollower), kFollower, 4 * std::sin(kFollower), -4 * std::cos(kFollower), friction),
                     "four_bar.toml");
}

Motion run_of(double friction) {
  const Trajectory run = reference::completed(worn_four_bar(friction));
  Motion motion;
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    const auto at = [&run, i](const char* column) { return reference::value(run, i, column); };
    motion.rows.push_back({run.at(i, 0), at("body.crank.angle"), at("body.coupler.angle"), at("body.follower.angle"), at("joint.b.on_coupler.fx[world]"), at("joint.b.on_coupler.fy[world]")});
  }
  for (const auto& event : run.events.at(0).events) motion.contacts.push_back(event.t);
  return motion;
}

// --- The tables ---

// Touches and releases are known to 1e-12 s, located on the depth in 80-bit arithmetic.
Motion table(const std::string& name, const std::vector<double>& contacts) {
  const reference::Table known = reference::read_table(name);
  Motion motion{{}, contacts};
  for (std::size_t i = 0; i < known.rows.size(); ++i) {
    const auto at = [&known, i](const char* column) { return known.at(i, column); };
    motion.rows.push_back({at("t"), at("theta2"), at("theta3"), at("theta4"), at("Fx"), at("Fy")});
  }
  return motion;
}
Motion frictionless_table() {
  return table("clearance_four_bar", {0.004981126443412547, 0.008359248341803831, 0.013413890965612572, 0.022415321138751068, 0.02341885112354967, 0.03321018147550278,
                                      0.03522470074959721, 0.2390336456681459, 0.24006341725804534});
}
Motion two_point_table() {
  return table("clearance_four_bar_two_points", {0.004981126443412547, 0.008308128182812185, 0.014675403906493674, 0.018381936440728247, 0.02246467247422871, 0.026566303430830017,
                                                 0.02891883560711465, 0.034006267297018916, 0.034510768075015845});
}

TEST(ClearanceFourBar, WithoutFrictionItIsTheTable) {
  const Motion known = frictionless_table();
  expect_same_motion(run_of(0), known);
  expect_same_motion(LooseFourBar(0, LooseFourBar::Arms::kOnePoint).solve(), known);
}

// Step by step, with both methods.
TEST(ClearanceFourBar, StepsTouchAndLetGoWhenTheyShould) {
  const std::vector<double> known = frictionless_table().contacts;
  for (const int stages : {3, 5}) {
    const Followed run = follow(worn_four_bar(0), stages == 3 ? 1e-8 : 1e-10, kDuration, {.stages = stages});
    ASSERT_EQ(run.contacts.size(), known.size());
    for (std::size_t i = 0; i < known.size(); ++i) EXPECT_NEAR(run.contacts[i].t, known[i], kTimeLimit) << i;
  }
}

TEST(ClearanceFourBar, WithFrictionItIsTheTableButForThePointOfContact) {
  const Motion run = run_of(kFriction), known = two_point_table();
  const Motion one = LooseFourBar(kFriction, LooseFourBar::Arms::kOnePoint).solve(), two = LooseFourBar(kFriction, LooseFourBar::Arms::kTwoPoints).solve();
  expect_same_motion(run, one);
  expect_same_motion(two, known);
  // The effect of the second point: above the tolerances of the tables, and the same between the two sets of equations as between run and table.
  const MotionDifference expected = motion_difference(one, two), found = motion_difference(run, known);
  EXPECT_NEAR(found.angle, expected.angle, kAngleLimit);
  EXPECT_NEAR(found.force, expected.force, kForceLimit);
  EXPECT_NEAR(found.time, expected.time, kTimeLimit);
  EXPECT_NEAR(expected.angle, 3.6e-7, 0.1e-7);
  EXPECT_NEAR(expected.force, 0.83, 0.01);
  EXPECT_NEAR(expected.time, 5.7e-6, 0.1e-6);
}

}  // namespace
}  // namespace pintle
