#include "system/speed_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <variant>

#include "base/constants.h"
#include "base/expression/expression_parser.h"
#include "base/units.h"

namespace pintle {
namespace {

Expression speed_of(const std::string& text) {
  ParseScope of_time;
  of_time.variables = {{"t", kTime}};
  const auto parsed = parse_expression(text, of_time);
  const auto* problem = std::get_if<ParseProblem>(&parsed);
  EXPECT_FALSE(problem) << text << ": " << (problem ? problem->because : "");
  return problem ? Expression() : std::get<ParsedExpression>(parsed).expression;
}

void expect_way(const std::string& speed, double duration, double until, const std::function<double(double)>& way, double error) {
  const SpeedIntegral integral(speed_of(speed), duration);
  for (int i = 0; i <= 1000; ++i) {
    const double t = until * i / 1000;
    EXPECT_NEAR(integral.integral_to(t), way(t), error) << speed << " at " << t;
  }
}

TEST(SpeedIntegral, IsTheIntegralOfTheSpeed) {
  expect_way("3 + 2*t/(1 s)", 2, 2, [](double t) { return 3 * t + t * t; }, 1e-14);
  expect_way("exp(-t/(1 s))", 5, 5, [](double t) { return 1 - std::exp(-t); }, 1e-14);
  expect_way("sin(300 rad/s*t)", 2, 2, [](double t) { return (1 - std::cos(300 * t)) / 300; }, 1e-14);
}

TEST(SpeedIntegral, PassesKinksAndJumps) {
  const auto smooth = [](double t) { return t < 0 ? 0 : t < 1 ? t * t * t - 0.5 * t * t * t * t : t - 0.5; };
  expect_way("smoothstep(0.7 s, 1.7 s, t)", 3, 3, [&](double t) { return smooth(t - 0.7); }, 1e-12);
  expect_way("if(t < 1 s/3, 2, -5)", 1, 1, [](double t) { return t < 1.0 / 3 ? 2 * t : 2.0 / 3 - 5 * (t - 1.0 / 3); }, 1e-12);
}

TEST(SpeedIntegral, GoesOnBeyondItsDuration) {
  expect_way("1 + sin(2 rad/s*t)", 0.5, 40, [](double t) { return t + 0.5 * (1 - std::cos(2 * t)); }, 1e-12);
}

// Shorter panels do not resolve the rounding of large arguments.
TEST(SpeedIntegral, KeepsToThePanelsThatItNeeds) {
  EXPECT_EQ(SpeedIntegral(speed_of("2 + t/(1 s)"), 10).n_panels(), 32u);
  EXPECT_LT(SpeedIntegral(speed_of("sin(314 rad/s*t)"), 100).n_panels(), 40000u);  // 5000 turns
}

TEST(SpeedIntegral, IsNoNumberWhereTheSpeedIsNone) {
  const SpeedIntegral integral(speed_of("sqrt(1 - t/(1 s))"), 2);
  EXPECT_NEAR(integral.integral_to(0.5), 2.0 / 3 * (1 - std::pow(0.5, 1.5)), 1e-12);
  EXPECT_TRUE(std::isnan(integral.integral_to(1.5)));
}

}  // namespace
}  // namespace pintle
