// Jumps of expressions: found between points, and on ramps.
#include <gtest/gtest.h>

#include <array>

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

TEST(ExpressionJumps, SidesTellWhereARampEnds) {
  const Expression e = law();
  const std::size_t jump = *e.jump_between(in_order(e, 0.9, 2), in_order(e, 1.2, 2));
  const Expression::Ramp ramp{jump, 0.5, 1, 0};
  const auto side = [&](double x) { return e.branches(in_order(e, x, 2), &ramp); };
  EXPECT_EQ(side(0.6), side(1.4));
  EXPECT_NE(side(0.4), side(0.6));
  EXPECT_NE(side(1.6), side(1.4));
  EXPECT_NE(side(1.6), side(0.4));
}

}  // namespace
}  // namespace pintle
