// Flexures in whole mechanisms: where loads settle, starts without ringing, frequencies, other equations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/constants.h"
#include "pintle/check.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::at_end;
using reference::completed;
using reference::drift;
using reference::value;

// Two steel blades hang from the ground and carry a table, which a force pushes at half their height.
Model stage(const std::string& push, const std::string& rest = "", double mass = 2, double thickness = 5e-4, double other_width = 0.03) {
  return parse_model(fmt::format(R"toml(
format = 1
name = "Stage"
{0}
[simulate]
duration = "0.3 s"
output_step = "5 ms"
tolerance = 1e-6
[ground.markers]
left = {{ x = -0.08, y = 0, axis = "-90 deg" }}
right = {{ x = 0.08, y = 0, axis = "-90 deg" }}
[body.table]
mass = {2}
inertia = 6e-3
markers.left = {{ x = -0.08, y = 0.015, axis = "-90 deg" }}
markers.right = {{ x = 0.08, y = 0.015, axis = "-90 deg" }}
markers.middle = [0, 0.065]
[joint.left]
type = "fixed"
between = ["ground.left", "table.left"]
law = "leaf-spring"
length = 0.1
width = 0.03
thickness = {3}
damping_time = 1e-4
[joint.right]
type = "fixed"
between = ["ground.right", "table.right"]
law = "leaf-spring"
length = 0.1
width = {4}
thickness = {3}
damping_time = 1e-4
[force.push]
on = "table.middle"
force = [{1}, 0]
)toml", rest, push, mass, thickness, other_width), "stage.toml");
}
constexpr double bending_stiffness(double width, double thickness) { return 207e9 * width * thickness * thickness * thickness / 12; }
constexpr double kBladeEI = bending_stiffness(0.03, 5e-4), kL = 0.1;
// Stiffness across one blade, guided in angle under this tension: theory/flexures section 2.
double guided_stiffness(double tension, double EI = kBladeEI) {
  const double k = std::sqrt(tension * kL * kL / EI);
  return EI / (kL * kL * kL) * k * k * k / (k - 2 * std::tanh(0.5 * k));
}

// No position is stated: the table is put at the ends of the blades. It starts where its weight and a push hold it, and stays there.
TEST(SlowFlexures, StartWhereTheLoadHoldsThem) {
  const Trajectory idle = completed(stage("0")), pushed = completed(stage("2"));
  const double x = at_end(pushed, "body.table.x");
  EXPECT_NEAR(at_end(idle, "body.table.y"), -0.115 - 0.5 * 2 * kStandardGravity * kL / (207e9 * 0.03 * 5e-4), 1e-10);
  EXPECT_NEAR(x * 2 * guided_stiffness(kStandardGravity) / 2, 1, 3e-4);
  EXPECT_NEAR((at_end(pushed, "body.table.y") - at_end(idle, "body.table.y")) / (0.6 * x * x / kL), 1, 0.02);
  for (std::size_t i = 0; i < pushed.n_rows(); ++i) {
    EXPECT_NEAR(value(pushed, i, "body.table.x"), x, 1e-9);
    for (const char* joint : {"left", "right"})
      for (const char* column : {"fx[world]", "fy[world]", "m[world]"}) {
        const std::string name = fmt::format("joint.{}.on_table.{}", joint, column);
        EXPECT_NEAR(value(pushed, i, name), at_end(pushed, name), 1e-6 * 2 * kStandardGravity) << name << ' ' << i;
      }
  }
  // The clamps carry the moment F L/4 each, less the part of the weight; and half of the weight.
  const double moment = 0.5 * 2 * 0.5 * kL - 0.5 * kStandardGravity * x, stress = moment * 6 / (0.03 * 25e-8) + kStandardGravity / (0.03 * 5e-4);
  EXPECT_NEAR(at_end(pushed, "joint.left.bending_stress"), stress, 0.02 * stress);
}

// Thin blades of different widths, pushed aside by up to three quarters of their length. Each is millions of times stiffer in stretch than in bending, along a curve
// of its own. A start that finds their gaps one by one puts the table hundreds of metres away.
TEST(SlowFlexures, StartUnlikeBladesTogether) {
  const double mass = 0.37, thickness = 3e-4, width = 0.01, weight = mass * kStandardGravity;
  for (const double push : {0.5, 1.5, 5.0, 10.0, 40.0}) {
    const Trajectory run = completed(stage(fmt::format("{}", push), "", mass, thickness, width));
    const double x = value(run, 0, "body.table.x"), left = value(run, 0, "joint.left.on_table.fy[world]"), right = value(run, 0, "joint.right.on_table.fy[world]");
    EXPECT_NEAR(left + right, weight, 1e-6 * weight) << push;
    EXPECT_NEAR(value(run, 0, "joint.left.on_table.fx[world]") + value(run, 0, "joint.right.on_table.fx[world]"), -push, 1e-6 * push) << push;
    for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_NEAR(value(run, i, "body.table.x"), x, 1e-6 * x) << push << ' ' << i;
    if (push > 1) continue;
    EXPECT_NEAR(x * (guided_stiffness(left, bending_stiffness(0.03, thickness)) + guided_stiffness(right, bending_stiffness(width, thickness))), push, 2e-3 * push);
  }
}

// A cantilever with a force across at its end, in elliptic integrals (Bisshopp and Drucker 1945): length, bending stiffness and the force are 1, 1 and alpha^2.
class Elastica {
 public:
  double k, first, alpha;  // modulus, amplitude at the root, root of the load

  explicit Elastica(double end) : k(std::sqrt(0.5 * (1 + std::sin(end)))), first(std::asin(1 / (k * std::numbers::sqrt2))), alpha(std::comp_ellint_1(k) - std::ellint_1(k, first)) {}
  struct Point {
    double along, across, slope;
  };
  /// At the arc length s, where F(amplitude) = F(first) + alpha s.
  Point at(double s) const {
    double low = first, high = 0.5 * kPi;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (std::ellint_1(k, middle) - std::ellint_1(k, first) < alpha * s ? low : high) = middle;
    }
    return {2 * k / alpha * (std::cos(first) - std::cos(high)), s - 2 / alpha * (std::ellint_2(k, high) - std::ellint_2(k, first)), 2 * std::asin(k * std::sin(high)) - 0.5 * kPi};
  }
};

// A weight at the free end of a long blade bends it far; the position is that of an inextensible elastica in elliptic integrals (Bisshopp and Drucker 1945). The
// blade's own stretch is below 1e-6 of its length.
TEST(SlowFlexures, StartFarBentUnderAWeight) {
  const Elastica elastica(0.9);
  const Elastica::Point end = elastica.at(1);
  const double L = 0.3, EI = bending_stiffness(0.02, 1e-3), mass = elastica.alpha * elastica.alpha * EI / (L * L) / kStandardGravity;
  const Trajectory run = completed(parse_model(fmt::format(R"toml(
format = 1
name = "Weight on a blade"
[simulate]
duration = "0.2 s"
output_step = "20 ms"
[ground.markers]
wall = [1, 2]
[body.weight]
mass = {:.17g}
inertia = 1e-4
markers.clamp = [0, 0]
[joint.blade]
type = "fixed"
between = ["ground.wall", "weight.clamp"]
law = "leaf-spring"
length = {}
width = 0.02
thickness = 1e-3
)toml", mass, L), "weight.toml"));
  for (const std::size_t row : {std::size_t{0}, run.n_rows() - 1}) {
    EXPECT_NEAR(value(run, row, "body.weight.y"), 2 - L * end.across, 3e-6 * L);
    EXPECT_NEAR(value(run, row, "body.weight.x"), 1 + L * end.along, 3e-6 * L);
    EXPECT_NEAR(value(run, row, "body.weight.angle"), -end.slope, 1e-5);
    EXPECT_NEAR(value(run, row, "joint.blade.on_weight.fy[world]"), mass * kStandardGravity, 1e-6 * mass * kStandardGravity);
    EXPECT_NEAR(value(run, row, "joint.blade.on_ground.m[world]"), -mass * kStandardGravity * L * end.along, 1e-4 * mass * kStandardGravity * L);
  }
}

// `n` blades in a row, with small bodies between them and at the end, where a force pulls across.
Model blades_in_a_row(int n, double length, const std::string& pull, const std::string& start) {
  std::string text = fmt::format(R"toml(
format = 1
name = "Blades in a row"
gravity = [0, 0]
[simulate]
duration = "0.2 s"
output_step = "20 ms"
start = "{}"
[ground.markers]
end = [1, 2]
[force.pull]
on = "b{}.end"
force = [0, "-{}"]
)toml", start, n, pull);
  for (int i = 1; i <= n; ++i)
    text += fmt::format(R"toml(
[body.b{0}]
mass = 1e-4
inertia = 1e-8
markers.end = [0, 0]
[joint.blade{0}]
type = "fixed"
between = ["{1}.end", "b{0}.end"]
law = "leaf-spring"
length = {2}
width = 0.02
thickness = 1e-3
damping_time = 1e-3
)toml", i, i == 1 ? "ground" : fmt::format("b{}", i - 1), length / n);
  return parse_model(text, "blades.toml");
}

// Positions, slopes, and forces and moments between the parts are those of the elastica, except for its stretch of 1e-6 of its length.
void expect_elastica(const Trajectory& run, std::size_t row, int n, double length, double pull, const Elastica& elastica) {
  for (int i = 1; i <= n; ++i) {
    const Elastica::Point point = elastica.at(static_cast<double>(i) / n), before = elastica.at((i - 1.0) / n);
    const std::string body = fmt::format("body.b{}.", i), joint = fmt::format("joint.blade{}.on_{}.", i, i == 1 ? "ground" : fmt::format("b{}", i - 1));
    EXPECT_NEAR(value(run, row, body + "x"), 1 + length * point.along, 1e-5 * length) << i << " of " << n;
    EXPECT_NEAR(value(run, row, body + "y"), 2 - length * point.across, 1e-5 * length) << i << " of " << n;
    EXPECT_NEAR(value(run, row, body + "angle"), -point.slope, 1e-5) << i << " of " << n;
    EXPECT_NEAR(value(run, row, joint + "fx[world]"), 0, 1e-5 * pull) << i << " of " << n;
    EXPECT_NEAR(value(run, row, joint + "fy[world]"), -pull, 1e-5 * pull) << i << " of " << n;
    EXPECT_NEAR(value(run, row, joint + "m[world]"), -pull * length * (elastica.at(1).along - before.along), 1e-5 * pull * length) << i << " of " << n;
  }
}

// Cut into 3 or 6 parts, a blade still bends as before, under a force that grows slowly. One integration: its end is an equilibrium, whatever the path to it.
TEST(SlowFlexures, BladesInARowAreTheElasticaThatTheyAreCutFrom) {
  const double L = 0.3, EI = bending_stiffness(0.02, 1e-3);
  for (const auto& [n, end] : {std::pair{3, 0.9}, {6, 1.3}}) {
    const Elastica elastica(end);
    const double pull = elastica.alpha * elastica.alpha * EI / (L * L);
    Trajectory run;
    const Integration done = reference::integrate_once(blades_in_a_row(n, L, fmt::format("{} N*smoothstep(0 s, 0.1 s, t)", pull), "unloaded"), 1e-3, 3, nullptr, &run);
    ASSERT_EQ(done.ended, Ended::kAtEnd) << done.message;
    expect_elastica(run, run.n_rows() - 1, n, L, pull, elastica);
  }
}

// Under a load that bends them by a quarter of a right angle, they start bent.
TEST(SlowFlexures, BladesInARowStartBent) {
  const double L = 0.3, EI = bending_stiffness(0.02, 1e-3);
  const Elastica elastica(0.4);
  const double pull = elastica.alpha * elastica.alpha * EI / (L * L);
  for (const int n : {3, 6}) {
    const Trajectory run = completed(blades_in_a_row(n, L, fmt::format("{} N", pull), "assembled"));
    expect_elastica(run, 0, n, L, pull, elastica);
    expect_elastica(run, run.n_rows() - 1, n, L, pull, elastica);
  }
}

// Without gravity 24 EI/L^3 for both blades; the weight that hangs on them makes them stiffer.
TEST(SlowFlexures, VibrateAsTheirStiffnessSays) {
  const double floating = check_model(stage("0", "gravity = [0, 0]")).frequencies.modes.front().frequency;
  EXPECT_NEAR(floating, std::sqrt(24 * kBladeEI / (kL * kL * kL) / 2), 1e-4 * floating);
  const double loaded = check_model(stage("0")).frequencies.modes.front().frequency;
  EXPECT_NEAR(loaded, std::sqrt(2 * guided_stiffness(kStandardGravity) / 2), 1e-3 * loaded);
}

TEST(SlowFlexures, MoveWithinTheEnergyAccountAndInRelativeCoordinates) {
  const std::string push = "\"4*(1 - cos(40*t))\"";
  Model model = stage(push, "gravity = [0, 0]");
  model.simulate.duration = 0.1;
  model.simulate.tolerance = 1e-5;
  const Trajectory free = completed(model);
  EXPECT_LT(drift(free), 1e-6);
  double swing = 0;
  for (std::size_t i = 0; i < free.n_rows(); ++i) swing = std::max(swing, std::abs(value(free, i, "body.table.x")));
  EXPECT_GT(swing, 3e-3);
  model.simulate.equations = Equations::kRelative;
  const Trajectory other = completed(model);
  for (std::size_t i = 0; i < free.n_rows(); ++i) {
    EXPECT_NEAR(value(other, i, "body.table.x"), value(free, i, "body.table.x"), 1e-5 * swing);
    EXPECT_NEAR(value(other, i, "joint.left.on_table.m[world]"), value(free, i, "joint.left.on_table.m[world]"), 1e-4 * free.joints[0].peak);
  }
}

// A run much shorter than the pivot's period of 0.8 s: the pivot is soft there, and a start that lets it follow the motion requires moments that no pivot has.
// Its forces balance those of the rail while next to nothing accelerates. In steps of half the motion they were wrong by 2 % between the stages, in all passes.
TEST(SlowFlexures, ABladePressedThroughItsStraightPositionNeedsItsOwnSteps) {
  Model model = reference::test_model("pressed_leaf_spring");
  for (const Equations equations : {Equations::kNewtonian, Equations::kRelative})
    for (const double tolerance : {1e-3, 1e-5, 1e-6}) {
      model.simulate.equations = equations;
      model.simulate.tolerance = tolerance;
      const Trajectory run = reference::completed(model);
      EXPECT_NEAR(run.joints.at(0).peak, 18.525184, tolerance * 18.5);  // at a tolerance of 1e-8; in steps of 5 ms at most, with (3.12) alone, 18.525
      EXPECT_LT(run.counters.steps, 400u);
    }
}

TEST(SlowFlexures, StartInRunsShorterThanTheirPeriod) {
  Model model = read_model(PINTLE_SOURCE_DIR "/mechanisms/cross_spring_pendulum.toml");
  model.simulate.duration = 0.02;
  const Trajectory run = completed(model);
  EXPECT_LT(run.counters.steps, 1000u);
  EXPECT_NEAR(value(run, 0, "joint.pivot.on_pendulum.fy[world]"), 0.5 * kStandardGravity, 1e-6 * 0.5 * kStandardGravity);
}

// A straight strut pressed beyond Euler's load: the run says where no equilibrium is left.
TEST(SlowFlexures, SayWhereABladeSnaps) {
  const double euler = 4 * kPi * kPi * kBladeEI / (kL * kL);
  const Trajectory run = simulate(parse_model(fmt::format(R"toml(
format = 1
name = "Strut"
gravity = [0, 0]
[simulate]
duration = "1 s"
output_step = "10 ms"
[ground.markers]
wall = [0, 0]
[body.piston]
mass = 1
inertia = 1e-3
markers.clamp = [0, 0]
[joint.guide]
type = "prismatic"
between = ["ground.wall", "piston.clamp"]
[joint.strut]
type = "fixed"
between = ["ground.wall", "piston.clamp"]
law = "leaf-spring"
length = 0.1
width = 0.03
thickness = 5e-4
damping_time = 1e-3
[force.press]
on = "piston.clamp"
force = ["{:.17g}*t", 0]
)toml", -2 * euler), "strut.toml"));
  const auto note = std::find_if(run.notes.begin(), run.notes.end(), [](const std::string& n) { return n.starts_with("joint strut lost its equilibrium at t = "); });
  ASSERT_NE(note, run.notes.end());
  EXPECT_NEAR(std::stod(note->substr(note->find("=") + 1)), 0.5, 0.0101);
  for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_EQ(value(run, i, "joint.strut.equilibrium"), run.at(i, 0) < 0.502) << run.at(i, 0);
}

// The bending of a blade couples displacement and angle of its end: without that coupling the first mode of check was twice as fast.
TEST(Flexures, AMassOnABladeVibratesAsOnACantilever) {
  constexpr double kLength = 2e-3, kWidth = 0.5e-3, kThickness = 1e-5, kModulus = 160e9, kMass = 1e-6;
  const double EI = kModulus * kWidth * std::pow(kThickness, 3) / 12, omega = std::sqrt(3 * EI / std::pow(kLength, 3) / kMass);
  const CheckFrequencies f = check_model(reference::test_model("mirror_on_a_blade")).frequencies;
  ASSERT_EQ(f.modes.size(), 3u);
  EXPECT_NEAR(f.modes[0].frequency, omega, 1e-3 * omega);
  ASSERT_EQ(f.components.size(), 3u);
  const auto across = std::find_if(f.components.begin(), f.components.end(), [](const CheckComponent& c) { return c.component == "y"; });
  ASSERT_NE(across, f.components.end());
  EXPECT_NEAR(across->stiffness, 12 * EI / std::pow(kLength, 3), 1e-9);
}

}  // namespace
}  // namespace pintle
