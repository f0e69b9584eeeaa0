// Friction in the joints of whole mechanisms: published motions that stick and slip, closed forms of what locks, friction circles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {
using reference::at_end;
using reference::completed;
using reference::drift;

bool says(const Trajectory& run, const std::string& what) {
  return std::any_of(run.notes.begin(), run.notes.end(), [&what](const std::string& note) { return note.find(what) != std::string::npos; });
}

// Largest differences, row by row, of a body's x and its rate from the table's columns x and `rate`.
std::pair<double, double> largest_differences(const Trajectory& run, const std::string& body, const reference::Table& table, const std::string& rate) {
  EXPECT_EQ(run.n_rows(), table.rows.size());
  double x = 0, v = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) {
    x = std::max(x, std::abs(reference::value(run, i, "body." + body + ".x") - table.at(i, "x")));
    v = std::max(v, std::abs(reference::value(run, i, "body." + body + ".vx") - table.at(i, rate)));
  }
  return {x, v};
}

Model pulled_mass(const std::vector<std::string>& overrides) {
  return parse_model(reference::pulled_mass(9.81, "friction = \"brown-mcphee\"\nfriction_coefficient = 0.1\nstatic_friction = 0.15\n"), "pulled.toml", overrides);
}

TEST(BrownMcPhee, PulledMassSticksAndSlipsAsComputedElsewhere) {
  const auto table = reference::read_table("brown_mcphee_stick_slip");
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = pulled_mass({"joint.slide.transition_speed=0.001"});
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    const auto [x, v] = largest_differences(run, "mass", table, "v");
    EXPECT_LT(x, tolerance);
    EXPECT_LT(v, tolerance);
    EXPECT_LT(drift(run), 1e-6);
  }
}

// Pulled by a spring K at V: stuck until the spring reaches mu_s N, then K y = K (V t - x) - mu_k N swings about zero, from y = d to y = -d, where the
// mass has stopped, with d = (mu_s - mu_k) N / K, w^2 = K / m. It slips for 2 (pi - atan(w d / V)) / w and sticks for 2 d / V.
struct StickSlip {
  double N = 9.81, still = 0.15, kinetic = 0.1, K = 2, V = 0.1, w = std::sqrt(2.0), d = (still - kinetic) * N / K;
  double first = still * N / (K * V), slips = 2 * (M_PI - std::atan(w * d / V)) / w, period = slips + 2 * d / V;

  /// Place, speed and friction.
  std::array<double, 3> at(double t) const {
    if (t < first) return {0, 0, K * V * t};
    const double cycle = std::floor((t - first) / period), s = t - first - cycle * period;
    const double y = d * std::cos(w * s) + V / w * std::sin(w * s), place = V * t - kinetic * N / K - y;
    if (s < slips) return {place, V + w * d * std::sin(w * s) - V * std::cos(w * s), kinetic * N};
    const double stopped = V * (first + cycle * period + slips) - kinetic * N / K + d;
    return {stopped, 0, K * (V * t - stopped)};
  }
  /// Just stopped: it rings down on its stick spring of 1e8 N/m, at the damper's 1500 / s.
  bool swings(double t) const {
    const double s = std::fmod(t - first + period, period) - slips;
    return s >= 0 && s < 0.02;
  }
};

TEST(Coulomb, PulledMassSticksAndSlipsAsInClosedForm) {
  const StickSlip truth;
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = pulled_mass({"joint.slide.friction=\"coulomb\"", "simulate.output_step=0.1"});
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      const double t = run.at(i, 0);
      const auto [x, v, friction] = truth.at(t);
      EXPECT_NEAR(reference::value(run, i, "joint.slide.slide"), x, 2e-7) << t;
      if (truth.swings(t)) continue;
      EXPECT_NEAR(reference::value(run, i, "body.mass.vx"), v, 1e-6) << t;
      EXPECT_NEAR(reference::value(run, i, "joint.slide.friction"), -friction, 1e-6) << t;
    }
    EXPECT_LT(drift(run), 1e-6);
    EXPECT_LT(run.counters.steps, 3100);
  }
}

// A block on an incline of tan A = mu (1 + excess), by the direction of gravity. The hand that holds it releases it within a second.
Model inclined(double excess) {
  return parse_model(R"toml(
format = 1
name = "Block at the friction angle"
[parameters]
mu = 0.15
excess = 0
angle = "atan(mu*(1 + excess))"
weight = "9.81 m/s^2"
pull = "2 kg*weight*sin(angle)"
[simulate]
duration = "1000 s"
output_step = "10 s"
[ground.markers]
o = [0, 0]
[body.block]
mass = 2
inertia = 0.01
position = [0, 0]
angle = 0
markers.c = [0, 0]
[joint.slide]
type = "prismatic"
between = ["ground.o", "block.c"]
friction = "coulomb"
friction_coefficient = "mu"
static_friction = "mu"
[force.weight]
on = "block.c"
force = ["pull*smoothstep(0, 1 s, t)", 0]
)toml", "inclined.toml", {"parameters.excess=" + std::to_string(excess), "gravity=[0, \"-weight*cos(angle)\"]"});
}

// 1e-6 below the friction angle it stays for 1000 s, on the stretch of its spring; 1e-6 above it slides off with an acceleration of mu g cos A times 1e-6.
TEST(Coulomb, HoldsUpToTheFrictionAngle) {
  const Trajectory held = completed(inclined(-1e-6));
  const double angle = std::atan(0.15), pull = 2 * 9.81 * std::sin(angle), a = 1e-6 * 0.15 * 9.81 * std::cos(angle);
  for (std::size_t i = 1; i < held.n_rows(); ++i) {
    EXPECT_NEAR(reference::value(held, i, "joint.slide.slide"), pull / 1e8, 1e-5 * pull / 1e8) << i;
    EXPECT_NEAR(reference::value(held, i, "joint.slide.slide"), at_end(held, "joint.slide.slide"), 1e-8 * pull / 1e8) << i;
    EXPECT_EQ(reference::value(held, i, "joint.slide.stuck"), 1) << i;
  }
  EXPECT_TRUE(says(held, "joint slide never slips"));
  EXPECT_LT(held.counters.steps, 200);
  const Trajectory slid = completed(inclined(1e-6));
  EXPECT_NEAR(at_end(slid, "joint.slide.slide"), 0.5 * a * 999 * 999, 1e-4 * a * 0.5e6);
  EXPECT_FALSE(says(slid, "jammed"));
}

// Rollers and drive of the belt are stiff: with a drive of 1e9 N/m the block breaks away so much later that x is off by 6e-7 m.
constexpr const char* kConveyor = R"toml(
format = 1
name = "Block on a conveyor belt"
gravity = [0, -9.81]
[simulate]
duration = "10 s"
output_step = "0.1 s"
[ground.markers]
o = [0, 0]
[body.belt]
mass = 10
inertia = 10
position = [0, 0]
angle = 0
velocity = [0.1, 0]
markers.c = [0, 0]
[body.block]
mass = 1
inertia = 0.01
position = [1, 0]
velocity = [0, 0]
angle = 0
hold = ["x"]
markers.c = [0, 0]
[joint.rollers]
type = "prismatic"
between = ["ground.o", "belt.c"]
stiffness = 1e11
angular_stiffness = 1e10
[joint.contact]
type = "prismatic"
between = ["belt.c", "block.c"]
friction = "stribeck"
friction_coefficient = 0.15
static_friction = 0.2
stribeck_speed = "0.001 m/s"
transition_speed = "1e-4 m/s"
[spring.s]
between = ["ground.o", "block.c"]
stiffness = "10 N/m"
free_length = "0.8 m"
[motor.drive]
joint = "rollers"
speed = 0.1
stiffness = 1e11
damping = 1e8
)toml";

TEST(Stribeck, BlockOnAConveyorBeltMovesAsPublished) {
  const auto table = reference::read_table("conveyor_belt");
  for (const double tolerance : {1e-5, 1e-7}) {
    Model model = parse_model(kConveyor, "conveyor.toml");
    model.simulate.tolerance = tolerance;
    const Trajectory run = completed(model);
    const auto [x, v] = largest_differences(run, "block", table, "vx");
    EXPECT_LT(x, tolerance);
    EXPECT_LT(v, tolerance);
    EXPECT_LT(drift(run), 1e-6);
  }
}

// From 1 s to 2 s.
double speed_gained(const Trajectory& run, const std::string& rate) { return at_end(run, rate) - reference::value(run, reference::row_at(run, 1), rate); }

// Once the whole load acts it moves no farther than bristles bend, mu / s_0, and comes to rest.
void expect_locked(const Trajectory& run, const std::string& column, double time, double mu) {
  const std::size_t loaded = reference::row_at(run, time);
  const auto slide = [&](std::size_t i) { return reference::value(run, i, column); };
  for (std::size_t i = loaded; i < run.n_rows(); ++i) EXPECT_LT(std::abs(slide(i) - slide(loaded)), mu / 1e5) << i;
  EXPECT_LT(std::abs(at_end(run, column) - slide(reference::row_at(run, 1.5))), 1e-3 * mu / 1e5);
}

// A wedge on a floor under a follower that moves up and down without friction; W presses the follower, rising from 0 to 0.5 s.
Model wedge(double angle, double mu, double mass) {
  return parse_model(R"toml(
format = 1
name = "Wedge"
gravity = [0, 0]
[parameters]
angle = 0
mu = 0.1
mass = 1
[simulate]
duration = "2 s"
output_step = "0.05 s"
[defaults.joint]
stiffness = 1e9
damping = 1e5
friction_coefficient = "mu"
static_friction = "mu"
[ground.markers]
floor = [0, 0]
guide = { x = 0, y = 0, axis = "90 deg" }
[body.wedge]
mass = "mass"
inertia = 1
position = [0, 0]
angle = 0
hold = ["x", "y", "angle"]
markers.floor = [0, 0]
markers.face = { x = 0, y = 0, axis = "angle" }
[body.follower]
mass = 2
inertia = 1
position = [0, 0]
angle = 0
markers.face = { x = 0, y = 0, axis = "angle" }
markers.guide = { x = 0, y = 0, axis = "90 deg" }
[joint.floor]
type = "prismatic"
between = ["ground.floor", "wedge.floor"]
friction = "lugre"
[joint.face]
type = "prismatic"
between = ["wedge.face", "follower.face"]
friction = "lugre"
[joint.guide]
type = "prismatic"
between = ["ground.guide", "follower.guide"]
[force.press]
on = "follower.face"
force = [0, "-1000 N*smoothstep(0, 0.5 s, t)"]
)toml", "wedge.toml", {"parameters.angle=" + std::to_string(angle), "parameters.mu=" + std::to_string(mu), "parameters.mass=" + std::to_string(mass)});
}

// Pressed on a wedge of angle A, with the friction angle phi on floor and face, the follower drives the wedge out when A > 2 phi. A heavy wedge moves so little
// that the press off the middle of the floor's joint does not tilt it.
//   R (cos A + mu sin A) = W - m_f a tan A,     m_w a = R (sin A - mu cos A) - mu R (cos A + mu sin A)
TEST(Jamming, WedgeLocksBelowTwiceTheFrictionAngle) {
  const double mu = 0.15, phi = std::atan(mu), hair = 0.1 * M_PI / 180;
  for (const char* word : {"lugre", "coulomb"}) {
    SCOPED_TRACE(word);
    const auto pressed = [&](double angle, double mass) {
      Model model = wedge(angle, mu, mass);
      for (Joint& joint : model.joints)
        if (!joint.friction.word.empty()) joint.friction.word = word;
      return completed(model);
    };
    expect_locked(pressed(2 * phi - hair, 1), "joint.floor.slide", 0.55, mu);
    const Trajectory driven = pressed(2 * phi + hair, 1e4);
    const double A = 2 * phi + hair, c = std::cos(A), s = std::sin(A), t = std::tan(A), W = 1000;
    const double drive = (s - mu * c) / (c + mu * s) - mu, a = drive * W / (1e4 + drive * 2 * t);
    EXPECT_NEAR(speed_gained(driven, "joint.floor.slide_rate"), a, 3e-4 * a);
  }
}

// A slider pushed along its guide by a force P at a distance of 200 mm from it.
Model pushed_block(double guide, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{"parameters.guide=" + std::to_string(guide)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return parse_model(R"toml(
format = 1
name = "Pushed beside its guide"
gravity = [0, 0]
[parameters]
guide = 1
[simulate]
duration = "2 s"
output_step = "0.05 s"
[ground.markers]
o = [0, 0]
[body.slider]
mass = 1
inertia = 0.01
markers.c = [0, 0]
markers.push = [0, 0.2]
[joint.guide]
type = "prismatic"
between = ["ground.o", "slider.c"]
friction = "lugre"
friction_coefficient = 0.15
guide_length = "guide"
[force.P]
on = "slider.push"
force = ["100 N*smoothstep(0, 0.5 s, t)", 0]
)toml", "pushed.toml", overrides);
}

// Its moment P h presses both edges with P h / L: the guide jams where it is shorter than 2 mu h, else a = P (1 - 2 mu h / L) / m.
TEST(Jamming, ShortGuideLocksASliderThatIsPushedBesideIt) {
  const double critical = 2 * 0.15 * 0.2;
  const Trajectory jammed = completed(pushed_block(0.999 * critical, {"simulate.tolerance=1e-8"}));  // bristles near their limit creep with each error of a step
  expect_locked(jammed, "joint.guide.slide", 0.5, 0.15);
  EXPECT_NEAR(at_end(jammed, "joint.guide.friction"), -100, 1e-5 * 100);
  const Trajectory moved = completed(pushed_block(1.001 * critical));
  EXPECT_NEAR(speed_gained(moved, "joint.guide.slide_rate"), 100 * (1 - 1 / 1.001), 1e-5 * 0.1);
}

// The run says that it jams, unless the guide is long enough.
TEST(Jamming, IsSaid) {
  for (const char* word : {"coulomb", "lugre"}) {
    SCOPED_TRACE(word);
    const std::vector<std::string> changes{fmt::format("joint.guide.friction=\"{}\"", word), "joint.guide.friction_preload=1"};
    const Trajectory jammed = completed(pushed_block(0.059, changes)), moved = completed(pushed_block(0.062, changes));
    EXPECT_TRUE(says(jammed, "joint guide never slips")) << jammed.notes.size();
    EXPECT_TRUE(says(jammed, "up to 100 N"));
    EXPECT_FALSE(says(moved, "jammed"));
    EXPECT_EQ(at_end(jammed, "joint.guide.stuck"), 1);
    EXPECT_EQ(at_end(moved, "joint.guide.stuck"), 0);
    EXPECT_NEAR(speed_gained(moved, "joint.guide.slide_rate"), 100 * (1 - 0.06 / 0.062) - 0.15, 1e-5 * 3);
  }
}

constexpr const char* kCircles = R"toml(
format = 1
name = "Four-bar that is all friction"
gravity = [0, 0]
[simulate]
duration = "6.4 s"
output_step = "0.05 s"
tolerance = 1e-5
[defaults.joint]
friction_coefficient = 0.2
static_friction = 0.2
pin_radius = "20 mm"
[ground.markers]
O2 = [0, 0]
O4 = [0.5, 0]
[body.crank]
mass = 1e-3
inertia = 1e-6
position = [0.05, 0]
angle = 0
spin = 1
hold = ["angle"]
markers.O2 = [-0.05, 0]
markers.A = [0.05, 0]
[body.coupler]
mass = 1e-3
inertia = 1e-6
position = [0.3, 0.15]
angle = 0.7
markers.A = [-0.25, 0]
markers.B = [0.25, 0]
[body.rocker]
mass = 1e-3
inertia = 1e-6
position = [0.5, 0.15]
angle = 1.6
markers.O4 = [-0.15, 0]
markers.B = [0.15, 0]
[joint.O2]
type = "revolute"
between = ["ground.O2", "crank.O2"]
friction = "lugre"
[joint.A]
type = "revolute"
between = ["crank.A", "coupler.A"]
friction = "lugre"
[joint.B]
type = "revolute"
between = ["coupler.B", "rocker.B"]
friction = "lugre"
[joint.O4]
type = "revolute"
between = ["ground.O4", "rocker.O4"]
friction = "lugre"
[motor.load]
joint = "O4"
torque = "-10 N*m"
[motor.drive]
joint = "O2"
speed = 1
)toml";

// The force between the two pins of the coupler is tangent to the circles of radius mu r about both, on the sides given by the pins' slips; it is (F, phi) on
// the rocker. With s = the sign of each pin's slip:
//   b sin(phi - theta_3) = mu r (s_B - s_A),   F (c sin(phi - theta_4) - mu r (s_B + s_4)) = -T,   T_2 = F (a sin(phi - theta_2) + mu r (s_2 - s_A))
TEST(FrictionCircles, FourBarCarriesItsLoadAlongTheirTangents) {
  const double a = 0.1, b = 0.5, c = 0.3, circle = 0.2 * 0.02, T = -10;
  for (const char* word : {"lugre", "coulomb", "stribeck", "brown-mcphee"}) {
    Model model = parse_model(kCircles, "circles.toml");
    for (Joint& joint : model.joints) joint.friction.word = word;
    const Trajectory run = completed(model);
    double worst[3] = {};
    int rows = 0;
    for (std::size_t i = 0; i < run.n_rows(); ++i) {
      const auto at = [&](const std::string& column) { return reference::value(run, i, column); };
      double slip[4], slowest = 1;
      const char* pins[4] = {"O2", "A", "B", "O4"};
      for (int k = 0; k < 4; ++k) {
        const double rate = at(std::string("joint.") + pins[k] + ".angle_rate");
        slip[k] = rate > 0 ? 1 : -1;
        slowest = std::min(slowest, 0.02 * std::abs(rate));
      }
      if (slowest < 5e-3) continue;
      ++rows;
      const double theta2 = at("body.crank.angle"), theta3 = at("body.coupler.angle"), theta4 = at("body.rocker.angle");
      const double tangent = std::asin(circle * (slip[2] - slip[1]) / b);
      const auto force = [&](double phi) { return -T / (c * std::sin(phi - theta4) - circle * (slip[2] + slip[3])); };
      double phi = theta3 + tangent;
      if (force(phi) < 0) phi = theta3 + M_PI - tangent;
      const double F = force(phi), torque = F * (a * std::sin(phi - theta2) + circle * (slip[0] - slip[1]));
      worst[0] = std::max(worst[0], std::abs(at("joint.B.on_rocker.fx[world]") - F * std::cos(phi)) / F);
      worst[1] = std::max(worst[1], std::abs(at("joint.B.on_rocker.fy[world]") - F * std::sin(phi)) / F);
      worst[2] = std::max(worst[2], std::abs(at("motor.drive.effort") - torque) / (a * F));
    }
    EXPECT_GT(rows, 30) << word;
    EXPECT_LT(run.counters.steps, 700) << word;
    for (const double difference : worst) EXPECT_LT(difference, 1e-5) << word;
  }
}

// A load on a rope hangs from a drum that a rubbing pin holds: it does not begin by sinking into the friction, and no joint rings. A coefficient that is stated
// alone also holds at rest. A load that the pin cannot hold turns it from the start, against its full friction.
TEST(Stiction, CarriesItsLoadFromTheStart) {
  const auto drum = [](double mass) {
    return parse_model(fmt::format(R"toml(
format = 1
[simulate]
duration = "0.1 s"
[ground.markers]
o = [0, 0]
[body.drum]
mass = 8
inertia = 0.04
position = [0, 0]
markers.o = [0, 0]
[body.load]
mass = {}
inertia = 0.1
position = [-0.1, -1]
markers.eye = [0, 0]
[joint.pin]
type = "revolute"
between = ["ground.o", "drum.o"]
friction = "coulomb"
friction_coefficient = 0.3
pin_radius = 0.05
[joint.rope]
type = "belt"
between = ["drum.o", "load.eye"]
first_radius = 0.1
first_side = "right"
stiffness = 1e6
damping = 300
)toml", mass), "drum.toml");
  };
  const double weight = kStandardGravity;
  const Trajectory held = completed(drum(1));
  for (std::size_t i = 0; i < held.n_rows(); ++i) {
    EXPECT_NEAR(reference::value(held, i, "joint.rope.on_load.fy[world]"), weight, 1e-5 * weight) << i;
    EXPECT_NEAR(reference::value(held, i, "joint.pin.friction"), -0.1 * weight, 1e-5 * weight) << i;
    EXPECT_EQ(reference::value(held, i, "joint.pin.stuck"), 1) << i;
  }
  const Trajectory turning = completed(drum(2));
  const double arm = 0.1, rubs_at = 0.3 * 0.05, turn = (2 * weight * (arm - rubs_at) - 8 * weight * rubs_at) / (0.04 + 2 * arm * (arm - rubs_at)), rope = 2 * (weight - arm * turn);
  for (std::size_t i = 0; i < turning.n_rows(); ++i) {
    EXPECT_NEAR(reference::value(turning, i, "joint.rope.on_load.fy[world]"), rope, 1e-4 * rope) << i;
    EXPECT_NEAR(reference::value(turning, i, "joint.pin.friction"), -rubs_at * (8 * weight + rope), 1e-4 * rubs_at * (8 * weight + rope)) << i;
    EXPECT_EQ(reference::value(turning, i, "joint.pin.stuck"), 0) << i;
  }
}

}  // namespace
}  // namespace pintle
