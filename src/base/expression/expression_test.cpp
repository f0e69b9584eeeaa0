#include "pintle/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/constants.h"
#include "base/expression/expression_ops.h"
#include "base/expression/expression_parser.h"
#include "base/units.h"

namespace pintle {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::optional<Quantity> constant_named(std::string_view name) {
  if (name == "crank") return Quantity{0.1, kLength};
  if (name == "ratio") return Quantity{2, kBareNumber};
  if (name == "broken") return Quantity{kNan, kMass};
  return std::nullopt;
}

ParseScope crank_scope() {
  return {constant_named,
          {"crank", "ratio"},
          {{"t", kTime}, {"angle", kAngle}, {"rate", kAngularSpeed}, {"hip-pin.angle", kAngle}, {"2a.slide", kLength}}};
}

struct Valued {
  const char* text;
  double value;
  Dimension dimension;
};

// Every variable is 0.5.
void expect_values(std::span<const Valued> cases) {
  for (const Valued& expected : cases) {
    const auto parsed = parse_expression(expected.text, crank_scope());
    const auto* problem = std::get_if<ParseProblem>(&parsed);
    ASSERT_FALSE(problem) << expected.text << ": " << problem->offset << " " << problem->because;
    const auto& found = std::get<ParsedExpression>(parsed);
    const std::vector<double> halves(found.expression.variables().size(), 0.5);
    EXPECT_NEAR(found.expression.value(halves), expected.value, 1e-14 * (1 + std::abs(expected.value)))
        << expected.text;
    EXPECT_EQ(found.dimension, expected.dimension) << expected.text << " is " << to_words(found.dimension);
    EXPECT_EQ(found.expression.text(), expected.text);
  }
}

TEST(ExpressionValue, NumbersWithUnits) {
  const Valued cases[] = {
      {"0", 0, kBareNumber},
      {" 2.5e-3 ", 2.5e-3, kBareNumber},
      {".5", 0.5, kBareNumber},
      {"5.", 5, kBareNumber},
      {"1e-400", 0, kBareNumber},
      {"25 mm", 0.025, kLength},
      {"25mm", 0.025, kLength},
      {"10 deg", kPi / 18, kAngle},
      {"2e8 N/m", 2e8, kStiffness},
      {"1500 rpm", 50 * kPi, kAngularSpeed},
      {"9.81 m/s^2", 9.81, kAcceleration},
      {"9.81 m / s ^ 2", 9.81, kAcceleration},
      {"-9.80665 m/s^2", -9.80665, kAcceleration},
      {"3000 N*s/m", 3000, kDamping},
      {"1e5 kg*m^2", 1e5, kInertia},
      {"0.2 N*m/rad", 0.2, kAngularStiffness},
      {"400 N/mm", 4e5, kStiffness},
      {"3 m/2", 1.5, kLength},
      {"(1/3) m", 1.0 / 3, kLength},
      {"(1 + 1) m/s", 2, kLinearSpeed},
      {"pi rad/s", kPi, kAngularSpeed},
      {"5 min", 300, kTime},
      {"90\xC2\xB0", kPi / 2, kAngle},
      {"2 kg\xC2\xB7m\xC2\xB2", 2, kInertia},
      {"\xE2\x88\x92"
       "2\xC3\x97"
       "3",
       -6, kBareNumber},
      {"1 in", 0.0254, kLength},
      {"6 km/(2 h)", 6000.0 / 7200, kLinearSpeed},
  };
  expect_values(cases);
}

TEST(ExpressionValue, OperatorsAndTheirOrder) {
  const Valued cases[] = {
      {"1 + 2*3", 7, kBareNumber},
      {"(1 + 2)*3", 9, kBareNumber},
      {"10 - 4 - 3", 3, kBareNumber},
      {"16/4/2", 2, kBareNumber},
      {"2^3^2", 512, kBareNumber},
      {"-2^2", -4, kBareNumber},
      {"2^-1", 0.5, kBareNumber},
      {"--3", 3, kBareNumber},
      {"2*-3", -6, kBareNumber},
      {"+4", 4, kBareNumber},
      {"1 < 2", 1, kBareNumber},
      {"1 > 2", 0, kBareNumber},
      {"2 <= 2", 1, kBareNumber},
      {"1 >= 1 + 1", 0, kBareNumber},
      {"(1 < 2)*(2 < 3)", 1, kBareNumber},
      {"2*crank + 5 mm", 0.205, kLength},
      {"crank^2", 0.01, {{2, 0, 0, 0}, false}},
      {"2 + crank", 2.1, kLength},
      {"pi/3", kPi / 3, kBareNumber},
      {"e", std::numbers::e, kBareNumber},
      {"1/crank", 10, {{-1, 0, 0, 0}, false}},
  };
  expect_values(cases);
}

TEST(ExpressionValue, Functions) {
  const Valued cases[] = {
      {"sin(30 deg)", 0.5, kBareNumber},
      {"cos(pi)", -1, kBareNumber},
      {"tan(45 deg)", 1, kBareNumber},
      {"asin(1)", kPi / 2, kAngle},
      {"acos(-1)", kPi, kAngle},
      {"atan(1)", kPi / 4, kAngle},
      {"atan2(1 m, -1 m)", 3 * kPi / 4, kAngle},
      {"sinh(1)", (std::exp(1) - std::exp(-1)) / 2, kBareNumber},
      {"cosh(1)", (std::exp(1) + std::exp(-1)) / 2, kBareNumber},
      {"tanh(0.5)", std::tanh(0.5), kBareNumber},
      {"exp(1)", std::numbers::e, kBareNumber},
      {"log(e^2)", 2, kBareNumber},
      {"sqrt(9 m^2)", 3, kLength},
      {"sqrt(8e3 N/m/(2 kg*m^2)*1 m^2)", std::sqrt(4000.0), {{0, 0, -1, 0}, false}},
      {"abs(-3 N)", 3, kForce},
      {"sign(-3 N)", -1, kBareNumber},
      {"sign(0)", 0, kBareNumber},
      {"min(1 m, 20 cm)", 0.2, kLength},
      {"max(1 m, 20 cm)", 1, kLength},
      {"pow(3 m, 2)", 9, {{2, 0, 0, 0}, false}},
      {"pow(4, 0.5)", 2, kBareNumber},
      {"(4 m^2)^0.5", 2, kLength},
      {"step(0)", 1, kBareNumber},
      {"step(-1 mm)", 0, kBareNumber},
      {"smoothstep(0, 2, 1)", 0.5, kBareNumber},
      {"smoothstep(0, 4, 1)", 0.15625, kBareNumber},
      {"smoothstep(0, 1, -5)", 0, kBareNumber},
      {"smoothstep(0, 1, 5)", 1, kBareNumber},
      {"smoothstep(1, 0, 0.25)", 0.84375, kBareNumber},
      {"smoothstep(1, 1, 2)", 1, kBareNumber},
      {"if(1 < 2, 3 m, 4 m)", 3, kLength},
      {"if(0, 3 m, 4)", 4, kLength},
      {"2*cos(60 deg)", 1, kBareNumber},
      {"crank*cos(60 deg)", 0.05, kLength},
  };
  expect_values(cases);
}

TEST(ExpressionValue, Variables) {
  const Valued cases[] = {
      {"t", 0.5, kTime},
      {"5 N*m - 0.1*rate", 4.95, kTorque},
      {"10 N*sin(2*t)", 10 * std::sin(1.0), kForce},
      {"0.2*sin(3*t)", 0.2 * std::sin(1.5), kBareNumber},
      {"1 rad/s*t", 0.5, kAngle},
      {"2*t", 1, kBareNumber},
      {"2 N*(t)", 1, {{1, 1, -1, 0}, false}},
      {"3 N*s/t", 6, kForce},
      {"-50 N*m/rad*angle", -25, kTorque},
      {"if(t < 1 s, 1 N, 0)", 1, kForce},
      {"0.1*abs(rate)^1.5", 0.1 * std::pow(0.5, 1.5), kBareNumber},
      {"hip-pin.angle", 0.5, kAngle},
      {"10 N*hip-pin.angle - 1 N", 4, {{1, 1, -2, 1}, false}},
      {"2*2a.slide", 1, kBareNumber},
      {"10 N/m*2a.slide", 5, {{1, 1, -2, 0}, false}},
      {"ratio*t", 1, kBareNumber},
      {"sin(angle)", std::sin(0.5), kBareNumber},
      {"2^angle", std::sqrt(2.0), kBareNumber},
      {"step(t - 1 s)*5 N", 0, kForce},
  };
  expect_values(cases);
}

TEST(ExpressionValue, VariablesComeInOrderOfAppearance) {
  const auto parsed = parse_expression("2*rate*t + rate + 0*angle", crank_scope());
  ASSERT_TRUE(std::holds_alternative<ParsedExpression>(parsed));
  const Expression& expression = std::get<ParsedExpression>(parsed).expression;
  EXPECT_EQ(expression.variables(), (std::vector<std::string>{"rate", "t", "angle"}));
  EXPECT_FALSE(expression.is_constant());
  const double values[] = {3, 5, 7};
  EXPECT_EQ(expression.value(values), 33);
}

TEST(ExpressionValue, ConstantsWithoutParsing) {
  EXPECT_EQ(Expression().value({}), 0);
  EXPECT_EQ(Expression().gradient({}, {}), 0);
  EXPECT_TRUE(Expression().is_constant());
  EXPECT_EQ(Expression().text(), "0");
  EXPECT_EQ(Expression::constant(0.1).value({}), 0.1);
  EXPECT_EQ(Expression::constant(0.1).text(), "0.1");
  EXPECT_EQ(Expression::constant(2).second_order({}, 0), (std::array<double, 3>{2, 0, 0}));
}

TEST(ExpressionValue, BadArgumentsGiveNoFiniteNumberAndNoThrow) {
  const std::pair<const char*, double> cases[] = {
      {"1/t", 0},           {"log(t/1 s)", -1},        {"sqrt(t)", -1},     {"asin(t/1 s)", 2},
      {"exp(t/1 s)", 1000}, {"min(t, 1)", kNan},       {"min(1, t)", kNan}, {"max(1, t)", kNan},
      {"step(t)", kNan},    {"if(t < 1, 1, 2)", kNan}, {"sign(t)", kNan},   {"smoothstep(0, 1, t)", kNan}};
  for (const auto& [text, t] : cases) {
    const auto parsed = parse_expression(text, crank_scope());
    ASSERT_FALSE(std::holds_alternative<ParseProblem>(parsed)) << text << std::get<ParseProblem>(parsed).because;
    const std::array<double, 1> values{t};
    EXPECT_FALSE(std::isfinite(std::get<ParsedExpression>(parsed).expression.value(values))) << text;
  }
}

TEST(ExpressionValue, QuantitiesAndBrokenConstants) {
  const auto quantity = parse_quantity("2*crank", crank_scope());
  EXPECT_DOUBLE_EQ(std::get<Quantity>(quantity).si, 0.2);
  EXPECT_TRUE(std::holds_alternative<ParseProblem>(parse_quantity("2*t", crank_scope())));
  EXPECT_DOUBLE_EQ(std::get<Quantity>(parse_quantity("2 t")).si, 2000);  // tonnes, if t is not a variable
  for (const char* text : {"broken + 1 m", "sqrt(broken)", "2 m^2*sin(broken)", "(2 m)^broken"}) {
    const auto broken = parse_quantity(text, crank_scope());
    ASSERT_TRUE(std::holds_alternative<Quantity>(broken)) << text;
    EXPECT_TRUE(std::isnan(std::get<Quantity>(broken).si)) << text;
  }
}

TEST(ExpressionNames, AConstantMayHaveTheSymbolOfAUnit) {
  const ParseScope scope{[](std::string_view name) -> std::optional<Quantity> {
                           if (name == "h") return Quantity{0.5, kLength};
                           if (name == "m") return Quantity{3, kMass};
                           if (name == "s") return Quantity{2, kBareNumber};
                           return {};
                         },
                         {"h", "m", "s"},
                         {}};
  const auto value = [&](const char* text) { return std::get<Quantity>(parse_quantity(text, scope)).si; };
  EXPECT_DOUBLE_EQ(value("2 h"), 7200);
  EXPECT_DOUBLE_EQ(value("2*h"), 1);
  EXPECT_DOUBLE_EQ(value("(3 kg)*h^2/12"), 0.0625);
  EXPECT_DOUBLE_EQ(value("h/2 + 1 m"), 1.25);
  EXPECT_DOUBLE_EQ(value("4 kg*m^2"), 4);  // not a mass times a mass
  EXPECT_DOUBLE_EQ(value("(4 kg)*m"), 12);
  EXPECT_DOUBLE_EQ(value("2*s"), 4);
  EXPECT_TRUE(std::holds_alternative<ParseProblem>(parse_quantity("9.81 m/s^2", scope)));  // a number may be meant
  for (const char* text : {"2 mm/h", "3 kg * h^2", "1 N/(m*h)"}) {
    const auto refused = parse_quantity(text, scope);
    ASSERT_TRUE(std::holds_alternative<ParseProblem>(refused)) << text;
    EXPECT_EQ(text[std::get<ParseProblem>(refused).offset], 'h') << text;
  }
}

TEST(ExpressionNames, ReservedAndPossible) {
  for (const char* word : {"sin", "if", "pi", "e", "min", "t"}) EXPECT_TRUE(is_reserved_name(word)) << word;
  for (const char* word : {"crank", "m1", "M", "m", "kg", "gravity", ""}) EXPECT_FALSE(is_reserved_name(word)) << word;
  for (const char* word : {"a", "_a1", "Abc"}) EXPECT_TRUE(is_identifier(word)) << word;
  for (const char* word : {"", "1a", "a-b", "a.b", "\xC2\xB0"}) EXPECT_FALSE(is_identifier(word)) << word;
  for (const FunctionInfo& info : function_catalog()) {
    EXPECT_TRUE(info.usage.starts_with(std::string(info.name) + "("));
    EXPECT_EQ(std::count(info.usage.begin(), info.usage.end(), ',') + 1, arity(info.op)) << info.name;
  }
}

TEST(Expression, AVariableMayBeFixed) {
  const auto parsed = parse_expression("3*t*angle + angle*t", crank_scope());
  ASSERT_TRUE(std::holds_alternative<ParsedExpression>(parsed));
  const Expression& moving = std::get<ParsedExpression>(parsed).expression;
  const Expression fixed = moving.substitute("t", 2);
  const std::vector<double> at{5, 7};
  std::vector<double> slope(2);
  EXPECT_EQ(fixed.value(at), 56);
  EXPECT_EQ(fixed.gradient(at, slope), 56);
  EXPECT_EQ(slope[0], 0);
  EXPECT_EQ(slope[1], 8);
  EXPECT_EQ(moving.value(at), 140);
  EXPECT_EQ(fixed.substitute("rate", 1).value(at), 56);
}

}  // namespace
}  // namespace pintle
