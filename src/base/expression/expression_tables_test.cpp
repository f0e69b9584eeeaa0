// Tables as functions of expressions: values, derivatives, kinks, units.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/expression/expression_parser.h"
#include "base/expression/switching_points.h"
#include "base/units.h"

namespace pintle {
namespace {

constexpr Dimension kPressure{{-1, 1, -2, 0}, false};

ParseScope table_scope() {
  const auto table = [](std::vector<double> x, std::vector<double> y, TableInterpolation how, std::optional<double> period = {}) {
    return std::make_shared<const TableFunction>(std::move(x), std::move(y), how, TableOutside::kHold, period);
  };
  ParseScope all;
  all.constant = [](std::string_view name) -> std::optional<Quantity> {
    if (name == "area") return Quantity{0.01, product(kLength, kLength).value()};
    return std::nullopt;
  };
  all.constant_names = {"area"};
  all.variables = {{"t", kTime}, {"O.angle", kAngle}, {"O.rate", kAngularSpeed}, {"x", kBareNumber}};
  all.tables = {{"pressure", kAngle, kPressure, table({0, 1, 2, 4}, {1e5, 9e5, 3e5, 2e5}, TableInterpolation::kLinear, 2 * std::numbers::pi)},
                {"curve", kAngularSpeed, kTorque, table({0, 100, 200, 300}, {8, 10, 9, 0}, TableInterpolation::kSpline)},
                {"bare", kBareNumber, kBareNumber, table({0, 1, 3}, {0, 2, 1}, TableInterpolation::kMonotone)}};
  return all;
}

Expression expression_with_tables(const char* text) {
  const auto parsed = parse_expression(text, table_scope());
  const auto* problem = std::get_if<ParseProblem>(&parsed);
  EXPECT_FALSE(problem) << text << ": " << (problem ? problem->because : "");
  return problem ? Expression() : std::get<ParsedExpression>(parsed).expression;
}

Dimension dimension_of(const char* text) { return std::get<ParsedExpression>(parse_expression(text, table_scope())).dimension; }

ParseProblem problem_of(const char* text) {
  const auto parsed = parse_expression(text, table_scope());
  const auto* problem = std::get_if<ParseProblem>(&parsed);
  EXPECT_TRUE(problem) << text;
  return problem ? *problem : ParseProblem();
}

TEST(ExpressionTables, AreCalledAsFunctions) {
  const Expression e = expression_with_tables("-area*(pressure(O.angle) - pressure(0.5))");
  EXPECT_EQ(e.variables(), std::vector<std::string>{"O.angle"});
  EXPECT_NEAR(e.value(std::array{1.5}), -0.01 * (6e5 - 5e5), 1e-9);
  EXPECT_NEAR(e.value(std::array{1.5 + 4 * std::numbers::pi}), -0.01 * (6e5 - 5e5), 1e-6);
  EXPECT_DOUBLE_EQ(expression_with_tables("curve(200 rad/s)").value({}), 9);
  EXPECT_DOUBLE_EQ(expression_with_tables("bare(bare(x))").value(std::array{1.0}), expression_with_tables("bare(x)").value(std::array{2.0}));
}

TEST(ExpressionTables, HaveExactDerivatives) {
  const Expression e = expression_with_tables("curve(O.rate + 3*sin(O.angle))*(1 + 0.1*pressure(2*O.angle)/(1e5 Pa)) + bare(0.2*x)*O.rate*(1 N*m*s)");
  const std::array<double, 3> at{130, 0.37, 4.5};
  ASSERT_EQ(e.variables(), (std::vector<std::string>{"O.rate", "O.angle", "x"}));
  std::array<double, 3> gradient;
  EXPECT_EQ(e.gradient(at, gradient), e.value(at));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto moved = [&](double d) {
      auto there = at;
      there[i] += d;
      return there;
    };
    const double h = 1e-3;
    const auto slope = [&](double d) { return (e.value(moved(d)) - e.value(moved(-d))) / (2 * d); };
    const auto bend = [&](double d) { return (e.second_order(moved(d), i)[1] - e.second_order(moved(-d), i)[1]) / (2 * d); };
    EXPECT_NEAR(gradient[i], (4 * slope(h) - slope(2 * h)) / 3, 1e-7) << i;
    EXPECT_NEAR(e.second_order(at, i)[2], (4 * bend(h) - bend(2 * h)) / 3, 1e-6) << i;
  }
}

// One switching function for each call of a table with kinks, wherever it occurs.
TEST(ExpressionTables, SwitchAtTheirKinks) {
  const Expression e = expression_with_tables("abs(x) + pressure(2*x)/(1 Pa) + bare(x)");
  ASSERT_EQ(e.n_switches(), 3);  // bare is held at its ends, where its slope jumps; its curvature jumps at 1
  const auto at = [&](double x) {
    std::array<double, 3> value;
    e.evaluate_switching_functions(std::array{x}, value.data());
    return value;
  };
  for (const double kink : {0.5, 1.0, 2.0, std::numbers::pi, std::numbers::pi + 0.5}) {
    const double h = 1e-7, before = at(kink - h)[1], behind = at(kink + h)[1];
    EXPECT_NEAR(std::abs(before), 2 * h, 1e-12) << kink;
    EXPECT_NEAR(behind, -before, 1e-12) << kink;
  }
  EXPECT_LT(at(-0.1)[2], 0);
  EXPECT_GT(at(0.5)[2], 0);
  EXPECT_LT(at(2)[2], 0);
  EXPECT_GT(at(3.1)[2], 0);
  EXPECT_EQ(expression_with_tables("curve(100 rad/s)*x").n_switches(), 0);  // a constant
}

void expect_places(const std::vector<double>& places, const std::vector<double>& expected) {
  ASSERT_EQ(places.size(), expected.size());
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-12);
}

// Independent of the number of parts; the two sides of `step` of a parabola lie in different parts, and those of a table of it are found in the same way.
TEST(ExpressionTables, SwitchingPointsAreFound) {
  const Expression straight = expression_with_tables("abs(x - 0.2) + pressure(2*x)/(1 Pa) + bare(x)");
  expect_places(switching_points(straight, 0.1, 4, 1, 100), {0.2, 0.5, 1, 2, 3, std::numbers::pi, std::numbers::pi + 0.5});
  expect_places(switching_points(expression_with_tables("pressure(1 - 2*x)/(1 Pa)"), -1, 0.2, 1, 100), {-0.5, 0});
  expect_places(switching_points(straight, 0.1, 4, 1000, 2), {0.2, 0.5, 1, 2, 3, std::numbers::pi, std::numbers::pi + 0.5});
  expect_places(switching_points(expression_with_tables("step(x*x - 0.25)"), -1, 1, 8, 100), {-0.5, 0.5});
  expect_places(switching_points(expression_with_tables("bare(x*x)"), 0.5, 2, 100, 100), {1, std::sqrt(3.0)});
  EXPECT_TRUE(switching_points(expression_with_tables("sin(x)"), 0, 10, 100, 100).empty());
  EXPECT_TRUE(switching_points(expression_with_tables("bare(0.2)*x"), 0, 10, 100, 100).empty());
}

TEST(ExpressionTables, HaveUnits) {
  EXPECT_EQ(dimension_of("pressure(O.angle)"), kPressure);
  EXPECT_EQ(dimension_of("area*pressure(O.angle)"), kForce);
  EXPECT_EQ(dimension_of("curve(O.rate)"), kTorque);
  EXPECT_EQ(dimension_of("pressure(2)"), kPressure);  // a bare number fits
  EXPECT_EQ(dimension_of("bare(O.rate)"), kBareNumber);
}

TEST(ExpressionTables, SayWhatIsWrongWithACall) {
  EXPECT_EQ(problem_of("2*pressure(O.rate)").offset, 11U);
  EXPECT_EQ(problem_of("pressure(O.rate)").because, "table pressure is a function of an angle [rad]");
  EXPECT_EQ(problem_of("pressure(O.angle, t)").because, "table pressure takes 1 argument");
  EXPECT_EQ(problem_of("pressure()").offset, 9U);
  EXPECT_EQ(problem_of("2*pressure + 1").because, "a table is called as a function");
  EXPECT_EQ(problem_of("presure(O.angle)").suggestion, "did you mean \"pressure\"?");
  EXPECT_EQ(problem_of("2 pressure(O.angle)").because, "an operator is missing before it");
  EXPECT_EQ(problem_of("pressure(O.angle) + 1 N").because, "both must be of the same kind");
  EXPECT_EQ(problem_of("pressure(O.angle").because, "it is never closed");
}

}  // namespace
}  // namespace pintle
