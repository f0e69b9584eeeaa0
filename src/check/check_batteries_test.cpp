// The batteries pass on every joint type and detect a wrong slope; kinks are not mistakes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <variant>

#include "base/expression/expression_parser.h"
#include "base/units.h"
#include "check/check_differences.h"
#include "check/check_links.h"
#include "check/check_samples_for_tests.h"
#include "system/build.h"

namespace pintle {
namespace {

Eigen::VectorXd one(double x) {
  return Eigen::VectorXd::Constant(1, x);
}

const CheckPlace kHere{"joint", "A", 0};

std::string failures(const CheckReport& report) {
  std::string text;
  for (const CheckBattery* battery : {&report.jacobians, &report.energy})
    for (const CheckItem& item : battery->items)
      if (!item.passed()) text += item.what + " " + std::to_string(item.worst) + " at " + item.place + "\n";
  return text;
}

TEST(CheckDifferences, RightAndWrongSlopes) {
  Comparisons right("sine", 1e-6), wrong("sine", 1e-6);
  const auto sine = [](double s) { return one(std::sin(0.3 + s)); };
  right.slope(one(std::cos(0.3)), sine, 1e-3, 0, kHere);
  wrong.slope(one(std::cos(0.3) * 1.00001), sine, 1e-3, 0, kHere);
  EXPECT_TRUE(right.item().passed());
  EXPECT_FALSE(wrong.item().passed());
  EXPECT_NEAR(wrong.item().worst, 1e-5, 1e-7);
  EXPECT_EQ(wrong.item().place, "joint A, as assembled");
}

TEST(CheckDifferences, KinksAreLeftOutAndSharpBendsAreNot) {
  Comparisons tally("bent", 1e-6);
  tally.slope(
      one(1), [](double s) { return one(std::max(0.0, s)); }, 1e-3, 0, kHere);
  tally.slope(
      one(0), [](double s) { return one(s > 0 ? 1.0 : 0.0); }, 1e-3, 0, kHere);
  EXPECT_EQ(tally.item().at_kinks, 2);
  EXPECT_EQ(tally.item().comparisons, 0);
  tally.slope(
      one(1e4), [](double s) { return one(std::tanh(1e4 * s)); }, 1e-3, 0, kHere);
  EXPECT_EQ(tally.item().comparisons, 1);
  EXPECT_TRUE(tally.item().passed());
  tally.slope(
      one(2e4), [](double s) { return one(std::tanh(1e4 * s)); }, 1e-3, 0, kHere);
  EXPECT_FALSE(tally.item().passed());
}

// The end of a smooth step: its slope is 0, but the differences reach that only in the limit.
TEST(CheckDifferences, SlopesWhoseSlopeJumpsAreLeftOut) {
  const auto start = [](double s) { return one(s > 0 ? 3 * s * s - 2 * s * s * s : 0.0); };
  Comparisons right("smooth step", 1e-6), wrong("smooth step", 1e-6);
  right.slope(one(0), start, 1e-3, 0, kHere);
  EXPECT_EQ(right.item().at_kinks, 1);
  EXPECT_EQ(right.item().comparisons, 0);
  wrong.slope(one(0.3), start, 1e-3, 0, kHere);
  EXPECT_FALSE(wrong.item().passed());
}

// The differences converge to the slope, but reach the roundoff of the curve just above the tolerance.
TEST(CheckDifferences, SlopesWhoseDifferencesEndInRoundingAreLeftOut) {
  const auto start = [](double s) { return one(3e4 + 3.3 * s + (s > 0 ? 50 * s * s : 0)); };
  Comparisons right("cam", 1e-6), wrong("cam", 1e-6);
  right.slope(one(3.3), start, 1e-3, 10, kHere);
  EXPECT_EQ(right.item().at_kinks, 1);
  EXPECT_EQ(right.item().comparisons, 0);
  wrong.slope(one(3.3 + 3e-4), start, 1e-3, 10, kHere);
  EXPECT_FALSE(wrong.item().passed());
}

// Hertzian contact at first touch, and an unloaded ball bearing: the slope begins as a root.
TEST(CheckDifferences, SlopesThatBeginAsARootAreLeftOut) {
  const auto hertz = [](double s) { return one(s > 0 ? 1e4 * std::pow(s, 1.5) : 0.0); };
  Comparisons right("hertz", 1e-6), wrong("hertz", 1e-6);
  right.slope(one(0), hertz, 1e-3, 300, kHere);
  EXPECT_EQ(right.item().at_kinks, 1);
  EXPECT_EQ(right.item().comparisons, 0);
  wrong.slope(one(30), hertz, 1e-3, 300, kHere);
  EXPECT_FALSE(wrong.item().passed());
}

TEST(CheckDifferences, ANumberThatIsNoneDoesNotPass) {
  Comparisons tally("nan", 1e-6);
  tally.slope(
      one(1), [](double) { return one(NAN); }, 1e-3, 0, kHere);
  EXPECT_FALSE(tally.item().passed());
}

// Far enough from it that every term shows, but not so far that joints carry loads of another order of magnitude.
TEST(CheckStates, AreNearTheAssembledOne) {
  const Model model = checked::four_bar(1, 4, 4, 6, kPi / 3);
  const System system = build_system(model);
  State assembled;
  for (const Body& body : model.bodies) {
    assembled.q.push_back({(*body.position)[0], (*body.position)[1], *body.angle});
    assembled.v.push_back({0, 0, 0});
  }
  const std::vector<CheckState> states = check_states(model, system, assembled);
  ASSERT_EQ(states.size(), 4u);
  for (std::size_t state = 1; state < states.size(); ++state)
    for (std::size_t body = 0; body < assembled.q.size(); ++body) {
      const Planar::Vec moved = states[state].q[body] - assembled.q[body];
      EXPECT_NE(moved[2], 0);
      EXPECT_LE(std::abs(moved[2]), 0.05);
      EXPECT_NE(moved.head<2>().norm(), 0);
      EXPECT_LE(moved.head<2>().cwiseAbs().maxCoeff(), 0.02 * states[state].length);
    }
}

// A mass on a cord from a drum of 0.3 m, with only 20 mm of cord free: 0.7 mm nearer, and there would be no tangent.
TEST(CheckStates, KeepTheEndOfARopeOutsideItsDrum) {
  Model model;
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {checked::bar("mass", 0.2, 1e-5, {0.3, -0.02}, 0, {{"c", {0, 0}, 0}})};
  model.bodies[0].velocity = Vec2{0.2, 0};
  Joint cord = checked::joint("cord", "belt", {"ground", "O"}, {"mass", "c"});
  cord.geometry = {{"first_radius", 0.3}};
  model.joints = {cord};
  EXPECT_EQ(failures(check_model(model)), "");
}

// A body held by one joint of each type, far from symmetric.
class EveryType : public testing::TestWithParam<std::string> {};

TEST_P(EveryType, PassesBothBatteries) {
  Model model;
  const std::string type = GetParam();
  model.ground = {{"O", {0.1, -0.2}, 0.3}, {"P", {-1, 0.4}, 0}};
  model.bodies = {checked::bar("bar", 2, 0.3, {0.5, 0.4}, 0.7, {{"O", {-0.4, 0.1}, 0.2}, {"P", {0.3, 0.2}, -0.5}}),
                  checked::bar("other", 3, 0.1, {1.1, 0.1}, -0.4, {{"O", {0.1, 0.2}, 1.1}, {"P", {-0.2, 0.1}, 0}})};
  Joint tested = checked::joint("tested", type, {"bar", "P"}, {"other", "O"});
  if (type == "gear") tested.geometry = {{"radius_first", 0.2}, {"radius_second", 0.5}, {"internal", 1}};
  if (type == "belt") tested.geometry = {{"first_radius", 0.1}, {"second_radius", 0.15}, {"stretch", 1e-3}};
  if (type == "rack") tested.geometry = {{"radius", 0.2}};
  model.joints = {checked::joint("pin", "revolute", {"ground", "O"}, {"bar", "O"}), tested};
  Spring spring;
  spring.name = "spring";
  spring.first = {"ground", "P"};
  spring.second = {"other", "P"};
  spring.stiffness = 400;
  spring.damping = 30;
  spring.free_length = 0.4;
  model.springs = {spring};
  AppliedForce force;
  force.name = "force";
  force.on = {"bar", "P"};
  force.force = {Expression::constant(20), Expression::constant(-5)};
  force.body_axes = type.size() % 2 == 0;
  model.forces = {force};
  const CheckReport report = check_model(model);
  EXPECT_EQ(failures(report), "");
  for (const CheckItem& item : report.jacobians.items)
    if (item.what == "gap Jacobians") {
      EXPECT_GT(item.comparisons, 40);
    }
}

INSTANTIATE_TEST_SUITE_P(Joints, EveryType,
                         testing::Values("revolute", "prismatic", "fixed", "slot", "rod", "rope", "belt", "gear", "rack"),
                         [](const auto& type) { return type.param; });

// A rope exactly at its length: force and tangent jump there, which is not a mistake.
TEST(CheckBatteries, RopeAtItsKink) {
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {checked::bar("load", 2, 0.3, {1, 0}, 0, {{"top", {0, 0}, 0}})};
  Joint rope = checked::joint("rope", "rope", {"ground", "O"}, {"load", "top"}, 1e6, 200);
  rope.geometry = {{"length", 1}};
  model.joints = {rope};
  EXPECT_EQ(failures(check_model(model)), "");
  // The kink is recognised even if another joint is ten thousand times as stiff.
  model.bodies.push_back(checked::bar("arm", 20, 3, {0, 0}, 0, {{"O", {0, 0}, 0}}));
  model.joints.push_back(checked::joint("pin", "revolute", {"ground", "O"}, {"arm", "O"}, 1e10, 1e5));
  EXPECT_EQ(failures(check_model(model)), "");
}

// A motor's target is compared with its differences, twice in each state: rate and acceleration. A constant speed has no target.
TEST(CheckBatteries, FunctionsThatMotorsFollow) {
  const auto compared = [](const Model& model) -> std::int64_t {
    const CheckReport report = check_model(model);
    EXPECT_EQ(failures(report), "");
    for (const CheckItem& item : report.jacobians.items)
      if (item.what == "derivatives of expressions") return item.comparisons;
    return 0;
  };
  Model model = checked::five_bar_parallelogram(0);
  EXPECT_EQ(compared(model), 0);
  model.motors[0].kind = MotorKind::kPosition;
  ParseScope scope;
  scope.variables = {{"t", kBareNumber}};
  model.motors[0].law = std::get<ParsedExpression>(parse_expression("1.1 + 0.2*sin(3*t)", scope)).expression;
  EXPECT_EQ(compared(model), 8);
  // At rest apart from roundoff, as a table at the ends of its period, and about to move.
  model.motors[0].law = std::get<ParsedExpression>(parse_expression("1.1 + 12*t^2*cos(8*t) + 1e-17*t", scope)).expression;
  EXPECT_EQ(compared(model), 8);
}

// The floor applies only if nothing else gives a scale.
TEST(CheckDifferences, OneSlopeIsItsOwnScale) {
  Comparisons tally("line", 1e-6);
  tally.slopes(Eigen::MatrixXd::Constant(1, 1, 1e3), [](int, double s) { return one(1e3 * (1 + 1e-8) * s); }, Eigen::VectorXd::Constant(1, 1e-3), 1e-6, kHere);
  EXPECT_TRUE(tally.item().passed());
}

}  // namespace
}  // namespace pintle
