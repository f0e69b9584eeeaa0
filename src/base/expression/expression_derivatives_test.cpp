#include <gtest/gtest.h>

#include <cmath>

#include "base/expression/expression_ops.h"
#include "base/expression/expression_parser.h"
#include "base/units.h"

namespace pintle {
namespace {

Expression expression_of(const std::string& text) {
  const ParseScope scope{{}, {}, {{"x", kBareNumber}, {"y", kBareNumber}, {"z", kBareNumber}}};
  const auto parsed = parse_expression(text, scope);
  const auto* problem = std::get_if<ParseProblem>(&parsed);
  EXPECT_FALSE(problem) << text << ": " << (problem ? problem->because : "");
  return problem ? Expression() : std::get<ParsedExpression>(parsed).expression;
}

double moved(const Expression& f, std::vector<double> values, std::size_t i, double by) {
  values[i] += by;
  return f.value(values);
}

// Central differences of order four for the first derivative, and of the exact gradient for the second.
void expect_exact(const std::string& text, std::vector<double> values) {
  const Expression f = expression_of(text);
  const std::size_t n = f.variables().size();
  values.resize(n);
  std::vector<double> gradient(n);
  EXPECT_EQ(f.gradient(values, gradient), f.value(values)) << text;
  const double h = 1e-3;
  for (std::size_t i = 0; i < n; ++i) {
    const double near = moved(f, values, i, h) - moved(f, values, i, -h);
    const double far = moved(f, values, i, 2 * h) - moved(f, values, i, -2 * h);
    EXPECT_NEAR(gradient[i], (8 * near - far) / (12 * h), 1e-8 * (1 + std::abs(gradient[i]))) << text << " " << i;

    const std::array<double, 3> jet = f.second_order(values, i);
    EXPECT_EQ(jet[0], f.value(values)) << text;
    EXPECT_EQ(jet[1], gradient[i]) << text;
    const auto slope_at = [&](double by) {
      std::vector<double> there = values;
      there[i] += by;
      return f.second_order(there, i)[1];
    };
    const double second = (8 * (slope_at(h) - slope_at(-h)) - (slope_at(2 * h) - slope_at(-2 * h))) / (12 * h);
    EXPECT_NEAR(jet[2], second, 1e-8 * (1 + std::abs(second))) << text << " " << i;
  }
}

TEST(ExpressionDerivative, EveryFunction) {
  const std::vector<std::pair<std::string, std::string>> arguments{
      {"atan2", "x, y"},          {"min", "x*x, y"}, {"max", "x*x, y"}, {"pow", "x, y"}, {"smoothstep", "x/9, y, z*z"},
      {"if", "x < y, x*y, x + y"}};
  for (const FunctionInfo& info : function_catalog()) {
    const std::string name(info.name);
    const auto it = std::find_if(arguments.begin(), arguments.end(), [&](const auto& a) { return a.first == name; });
    const std::string inside = it != arguments.end() ? it->second : "0.3*x*y + 0.1*z*z";
    expect_exact(name + "(" + inside + ")", {0.7, 1.3, 0.6});
    expect_exact(name + "(" + inside + ")", {0.4, 0.9, 0.8});
    expect_exact("x*" + name + "(" + inside + ")^2 + 1/(2 + y)", {0.8, 0.95, 0.75});
  }
}

TEST(ExpressionDerivative, EveryOperator) {
  for (const char* text :
       {"x + y*x", "x - y - x*x", "x*y*z*x", "x/y/z", "-x/(x + y)", "x^3", "x^y", "2^x", "x^-2", "x^0", "x^1", "x^0.5",
        "(x*y)^(y + z)", "(x < y)*x", "x*(x > y) + (x <= z) + (x >= z)", "sin(x)^2 + cos(x)^2", "exp(-x*y)*sin(3*z)"}) {
    expect_exact(text, {0.7, 1.3, 0.6});
  }
}

TEST(ExpressionDerivative, NegativeArguments) {
  expect_exact("x^3 + x^2", {-0.7});
  expect_exact("abs(x)*x", {-0.7});
  expect_exact("atan2(x, y)", {-0.7, -0.3});
  expect_exact("sign(x)*x^2", {-0.7});
  expect_exact("asin(x) + acos(y)", {-0.5, -0.2});
}

TEST(ExpressionDerivative, AtKinksItIsThatBehindThem) {
  struct Kink {
    const char* text;
    double x;
    double slope;
  };
  const Kink kinks[] = {
      {"abs(x)", 0, 1},
      {"abs(-x)", 0, 1},
      {"abs(x^2)", 0, 0},
      {"sign(x)", 0, 0},
      {"step(x)", 0, 0},
      {"min(x, 2*x)", 0, 1},
      {"max(2*x, x)", 0, 2},
      {"min(x, 1)", 1, 0},
      {"max(1, x)", 1, 1},
      {"max(0, (x - 1)^2)", 1, 0},
      {"smoothstep(0, 1, x)", 0, 0},
      {"smoothstep(0, 1, x)", 1, 0},
      {"if(x < 1, x, 5*x)", 1, 5},
      {"if(x <= 1, x, 5*x)", 1, 1},
      {"sqrt(x^2)", 0, 0},
      {"smoothstep(1, 1, x)", 1, 0},
      {"x^2", 0, 0},
      {"x^1", 0, 1},
      {"x^0", 0, 0},
  };
  for (const Kink& kink : kinks) {
    const std::array<double, 1> values{kink.x};
    std::array<double, 1> gradient{-99};
    expression_of(kink.text).gradient(values, gradient);
    EXPECT_EQ(gradient[0], kink.slope) << kink.text;
  }
}

TEST(ExpressionDerivative, InfiniteSlopeDoesNotSpoilTheOtherVariables) {
  const Expression f = expression_of("sqrt(x) + y*y");
  const std::array<double, 2> values{0, 3};
  std::array<double, 2> gradient{};
  EXPECT_EQ(f.gradient(values, gradient), 9);
  EXPECT_TRUE(std::isinf(gradient[0]));
  EXPECT_EQ(gradient[1], 6);
  EXPECT_EQ(f.second_order(values, 1), (std::array<double, 3>{9, 6, 2}));
}

TEST(ExpressionDerivative, SecondOrderByHand) {
  const Expression f = expression_of("x^4*y");
  const std::array<double, 2> values{2, 3};
  EXPECT_EQ(f.second_order(values, 0), (std::array<double, 3>{48, 96, 144}));
  EXPECT_EQ(f.second_order(values, 1), (std::array<double, 3>{48, 16, 0}));
}

}  // namespace
}  // namespace pintle
