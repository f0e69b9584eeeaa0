// Jumps of expressions: found between points, and replaced by ramps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/expression/expression_parser.h"
#include "base/units.h"
#include "pintle/expression.h"

namespace pintle {
namespace {

Expression law() {
  ParseScope scope;
  scope.variables = {{"x", kBareNumber}, {"y", kBareNumber}};
  return std::get<ParsedExpression>(parse_expression("if(x > 0.5*y, 3 + x*y, y^2 - x) + abs(y)", scope)).expression;
}

std::array<double, 2> in_order(const Expression& e, double x, double y) {
  return e.variables()[0] == "x" ? std::array{x, y} : std::array{y, x};
}

TEST(ExpressionJumps, AreFoundBetweenPoints) {
  const Expression e = law();
  const auto low = in_order(e, 0.9, 2), high = in_order(e, 1.2, 2), other = in_order(e, 0.9, 3);
  EXPECT_FALSE(e.jump_between(low, other).has_value());
  const auto jump = e.jump_between(low, high);
  ASSERT_TRUE(jump.has_value());
  EXPECT_DOUBLE_EQ(e.margin(*jump, low), -0.1);
  EXPECT_DOUBLE_EQ(e.margin(*jump, high), 0.2);
}

// A value exactly on the jump belongs to the side that the comparison gives it: 25 is not less than 25, and not more either.
TEST(ExpressionJumps, TheComparisonDecidesOnWhichSideTheJumpItselfIs) {
  ParseScope scope;
  scope.variables = {{"x", kBareNumber}};
  const std::array at{25.0}, below{std::nextafter(25.0, 0.0)}, above{std::nextafter(25.0, 30.0)};
  for (const auto& [text, with_below] : {std::pair{"if(x < 25, 12, 0)", false}, std::pair{"if(x >= 25, 12, 0)", false}, std::pair{"if(x > 25, 12, 0)", true}, std::pair{"if(x <= 25, 12, 0)", true}}) {
    const Expression e = std::get<ParsedExpression>(parse_expression(text, scope)).expression;
    EXPECT_EQ(e.jump_between(below, at).has_value(), !with_below) << text;
    EXPECT_EQ(e.jump_between(at, above).has_value(), with_below) << text;
    EXPECT_TRUE(e.jump_between(below, above).has_value()) << text;
  }
}

// abs(y) has a kink but no jump.
TEST(ExpressionJumps, AKinkIsNone) {
  const Expression e = law();
  EXPECT_FALSE(e.jump_between(in_order(e, -3, -2), in_order(e, -3, 2)).has_value());
}

TEST(ExpressionJumps, ARampMixesBothSides) {
  const Expression e = law();
  const std::size_t jump = *e.jump_between(in_order(e, 0.9, 2), in_order(e, 1.2, 2));
  const Expression::Ramp ramp{jump, 0.3, 5, 0.01};
  const double x = 1.05, y = 2, share = 0.3 + 5 * (0.05 - 0.01), low = y * y - x + y, high = 3 + x * y + y;
  std::array<double, 2> slope;
  EXPECT_NEAR(e.gradient(in_order(e, x, y), slope, ramp), low + share * (high - low), 1e-14);
  const double by_x = (1 - share) * -1 + share * y + 5 * (high - low), by_y = (1 - share) * 2 * y + share * x + 1 - 0.5 * 5 * (high - low);
  EXPECT_NEAR(slope[e.variables()[0] == "x" ? 0 : 1], by_x, 1e-13);
  EXPECT_NEAR(slope[e.variables()[0] == "x" ? 1 : 0], by_y, 1e-13);
}

TEST(ExpressionJumps, SwitchingFunctionsTellWhereARampEnds) {
  const Expression e = law();
  const std::size_t jump = *e.jump_between(in_order(e, 0.9, 2), in_order(e, 1.2, 2));
  const Expression::Ramp ramp{jump, 0.5, 1, 0};
  ASSERT_EQ(e.n_switches(), 2);
  const auto outside = [&](double x) {
    std::array<double, 2> value;
    e.evaluate_switching_functions(in_order(e, x, 2), value.data(), &ramp);
    return value[0];
  };
  EXPECT_NEAR(outside(0.6), -0.1, 1e-15);
  EXPECT_NEAR(outside(1.4), -0.1, 1e-15);
  EXPECT_NEAR(outside(0.4), 0.1, 1e-15);
  EXPECT_NEAR(outside(1.6), 0.1, 1e-15);
}

// Every operation with a kink or a jump, on both sides of it and on it: the sign is that of the formula that applies.
TEST(ExpressionJumps, SwitchingFunctionsAreSignedDistances) {
  ParseScope scope;
  scope.variables = {{"x", kBareNumber}};
  const auto at = [&scope](const char* text, double x) {
    const Expression e = std::get<ParsedExpression>(parse_expression(text, scope)).expression;
    std::vector<double> value(e.n_switches());
    e.evaluate_switching_functions(std::array{x}, value.data());
    return value;
  };
  for (const double x : {-1.0, 0.0, 2.5}) {
    for (const char* text : {"abs(x)", "sign(x)", "step(x)"}) EXPECT_EQ(at(text, x), std::vector{-x}) << text;
    for (const char* text : {"min(x, 1)", "max(x, 1)", "if(x < 1, 2, 3)", "if(x >= 1, 2, 3)"}) EXPECT_EQ(at(text, x), std::vector{1 - x}) << text;
    for (const char* text : {"if(x > 1, 2, 3)", "if(x <= 1, 2, 3)"}) EXPECT_EQ(at(text, x), std::vector{x - 1}) << text;
    EXPECT_EQ(at("smoothstep(0, 2, x)", x), (std::vector{-x, 2 - x}));
    EXPECT_EQ(at("abs(x) + 2*min(x, 1)", x), (std::vector{-x, 1 - x}));
    EXPECT_EQ(at("atan2(x, -1)", x), std::vector{-x});
    EXPECT_EQ(at("tan(x)", x), std::vector{std::cos(x)});
    EXPECT_TRUE(at("sin(x)^2", x).empty());
  }
}

}  // namespace
}  // namespace pintle
