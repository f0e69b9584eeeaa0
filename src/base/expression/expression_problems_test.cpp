#include "base/expression/expression_problems.h"

#include <gtest/gtest.h>

#include "base/units.h"

namespace pintle {
namespace {

ParseScope length_scope() {
  const auto constant = [](std::string_view name) -> std::optional<Quantity> {
    if (name == "crank") return Quantity{0.1, kLength};
    return std::nullopt;
  };
  return {constant, {"crank"}, {{"t", kTime}, {"rate", kAngularSpeed}, {"hip-pin.angle", kAngle}}};
}

struct Fault {
  std::string text;
  std::size_t offset;
  const char* found;       // part of it
  const char* because;     // part of it
  const char* suggestion;  // part of it
};

void expect_problem(const Fault& fault) {
  const auto parsed = parse_expression(fault.text, length_scope());
  ASSERT_TRUE(std::holds_alternative<ParseProblem>(parsed)) << fault.text;
  const auto& problem = std::get<ParseProblem>(parsed);
  EXPECT_EQ(problem.offset, fault.offset) << fault.text << ": " << problem.because;
  EXPECT_NE(problem.found.find(fault.found), std::string::npos) << fault.text << ": " << problem.found;
  EXPECT_NE(problem.because.find(fault.because), std::string::npos) << fault.text << ": " << problem.because;
  EXPECT_NE(problem.suggestion.find(fault.suggestion), std::string::npos) << fault.text << ": " << problem.suggestion;
}

TEST(ExpressionProblem, Dimensions) {
  const Fault faults[] = {
      {"crank + 1 s", 6, "a length [m] + a time [s]", "same kind", ""},
      {"1 + crank - 2 kg", 10, "a length [m] - a mass [kg]", "same kind", ""},
      {"sin(crank)", 4, "a length [m]", "sin needs a number or an angle", ""},
      {"sin(t)", 4, "a time [s]", "sin needs", "1 rad/s"},
      {"2*exp( 3 kg )", 7, "a mass [kg]", "exp needs", ""},
      {"asin(1 m)", 5, "a length", "asin needs", ""},
      {"sqrt(crank)", 5, "the square root of a length [m]", "fractional", ""},
      {"crank^0.5", 5, "a length [m] to a power", "fractional", ""},
      {"(1 m)^1e9", 5, "to a power", "huge exponent", ""},
      {"crank^t", 5, "a time [s]", "an exponent needs a number", ""},
      {"crank^hip-pin.angle", 5, "a length [m] to a power", "must be a constant", ""},
      {"2^crank", 1, "a length", "an exponent needs a number", ""},
      {"pow(crank, 0.3)", 11, "a length", "fractional", ""},
      {"min(crank, 1 kg)", 11, "a length [m] and a mass [kg]", "same kind", ""},
      {"atan2(crank, 1 s)", 13, "and a time", "same kind", ""},
      {"smoothstep(0, crank, t)", 21, "a length [m] and a time [s]", "same kind", ""},
      {"if(t, 1, 2)", 3, "a time", "a condition needs a number", ""},
      {"if(1, crank, t)", 13, "and a time", "same kind", ""},
      {"crank < t", 6, "a length [m] < a time [s]", "same kind", ""},
      {"crank >= 1 kg", 6, ">=", "same kind", ""},
      {"(1 m^20)^5*1 m", 10, "", "too large", ""},
  };
  for (const Fault& fault : faults) expect_problem(fault);
}

TEST(ExpressionProblem, NamesAndUnits) {
  const Fault faults[] = {
      {"2*crnk", 2, "\"crnk\"", "not defined here", "\"crank\""},
      {"sine(1)", 0, "\"sine\"", "not defined here", "\"sin\""},
      {"hip.angle", 0, "\"hip.angle\"", "not defined here", "\"hip-pin.angle\""},
      {"t.angle", 0, "\"t.angle\"", "not defined here", ""},
      {"sin", 0, "sin", "needs arguments", "sin(x)"},
      {"2 + mm", 4, "\"mm\"", "a number in front", "1 mm"},
      {"25 mn", 3, "\"mn\"", "no unit", "\"mN\""},
      {"5 Nm", 2, "\"Nm\"", "no unit", "N*m"},
      {"5 kNm", 2, "\"kNm\"", "no unit", "kN*m"},
      {"2 sec", 2, "\"sec\"", "no unit", "s"},
      {"5 N m", 4, "\"m\"", "operator is missing", "*m or /m"},
      {"smoothstep(t, 1, 5)", 17, "a constant", "what varies comes last", "smoothstep(from, to, t)"},
      {"smoothstep(0, t, 5)", 17, "a constant", "what varies comes last", "smoothstep(from, to, t)"},
      {"2*t N", 4, "\"N\"", "operator is missing", "*1 N"},
      {"2 crank", 2, "\"crank\"", "operator is missing", "*crank"},
      {"2 t", 2, "\"t\"", "operator is missing", "*t"},
      {"crank 2", 6, "\"2\"", "operator is missing", "*2"},
      {"crank(2)", 5, "\"(\"", "operator is missing", ""},
      {"2 m^2.5", 3, "", "exponent of a unit", ""},
      {"2 m^t", 3, "", "exponent of a unit", ""},
      {"2 m^99", 3, "", "exponent of a unit", ""},
      {"2 N*m^20*m^20*m^20*m^20*m^20", 23, "", "too large", ""},
  };
  for (const Fault& fault : faults) expect_problem(fault);
}

// An edge's height is a function of x: t would be the tonne there.
TEST(ExpressionProblem, TimeWhereOnlySomethingElseStands) {
  ParseScope scope;
  scope.variables = {{"x", kLength}};
  const auto parsed = parse_expression("2*smoothstep(0, 1, t)", scope);
  ASSERT_TRUE(std::holds_alternative<ParseProblem>(parsed));
  EXPECT_EQ(std::get<ParseProblem>(parsed).because, "this is a function of x, in which time does not stand");
  EXPECT_EQ(std::get<ParseProblem>(parsed).suggestion, "x; 1 t for a tonne");
}

TEST(ExpressionProblem, Grammar) {
  const Fault faults[] = {
      {"", 0, "an empty text", "expected", ""},
      {"   ", 0, "an empty text", "expected", ""},
      {"1 +", 3, "the end", "missing here", ""},
      {"1 + * 2", 4, "\"*\"", "missing here", ""},
      {"2**3", 2, "\"*\"", "missing here", "^"},
      {"(1 + 2", 0, "opening parenthesis", "never closed", ")"},
      {"sin(1", 3, "opening parenthesis", "never closed", ")"},
      {"min(1", 3, "opening parenthesis", "never closed", ")"},
      {"1)", 1, "closing parenthesis", "no parenthesis is open", ""},
      {"()", 1, "\")\"", "missing here", ""},
      {"2,5 mm", 1, "a comma", "arguments", "point"},
      {"1, 2", 1, "a comma", "arguments", "one expression"},
      {"t,5 mm", 1, "a comma", "arguments", "one expression"},
      {"sin()", 4, "", "takes 1 argument", "sin(x)"},
      {"min(1)", 5, "", "takes 2 arguments", "min(a, b)"},
      {"min(1, 2, 3)", 8, "", "takes 2 arguments", "min(a, b)"},
      {"if(1, 2 m)", 9, "", "takes 3 arguments", "if("},
      {"1 < 2 < 3", 6, "", "chained", "multiply"},
      {"t = 2", 2, "\"=\"", "equation", "<="},
      {"t == 2", 2, "\"=\"", "equation", "<="},
      {"1 # 2", 2, "\"#\"", "not allowed", ""},
      {"1 \xE2\x82\xAC", 2, "\"\xE2\x82\xAC\"", "not allowed", ""},
      {"$", 0, "\"$\"", "missing here", ""},
      {".", 0, "\".\"", "missing here", ""},
      {"1.2.3", 3, "", "not allowed", ""},
      {"1e999", 0, "1e999", "too large", ""},
      {"1/0", 1, "", "finite", ""},
      {"2 + log(0)", 4, "", "finite", ""},
      {"sqrt(-1)", 0, "", "finite", ""},
      {"10^400", 2, "", "finite", ""},
      {"1e300 km^20", 6, "", "finite", ""},
  };
  for (const Fault& fault : faults) expect_problem(fault);
}

TEST(ExpressionProblem, Limits) {
  const auto nested = [](const std::string& open, std::size_t n, const std::string& core, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += open;
    text += core;
    for (std::size_t i = 0; i < n; ++i) text += close;
    return text;
  };
  EXPECT_FALSE(std::holds_alternative<ParseProblem>(parse_expression(nested("(", 150, "t", ")"), length_scope())));
  EXPECT_FALSE(std::holds_alternative<ParseProblem>(parse_expression(nested("sin(", 150, "1", ")"), length_scope())));
  expect_problem({nested("(", 300, "t", ")"), 200, "", "too deeply", ""});
  expect_problem({nested("-", 300, "t", ""), 200, "", "too deeply", ""});
  expect_problem({nested("2^", 300, "t", ""), 400, "", "too deeply", ""});
  expect_problem({nested("max(t, ", 190, "t", ")"), 0, "", "too deeply", ""});  // too many operands on the stack
  expect_problem({std::string(5000, ' '), 0, "", "longer than", ""});
  EXPECT_FALSE(std::holds_alternative<ParseProblem>(parse_expression(nested("t + ", 900, "t", ""), length_scope())));
}

}  // namespace
}  // namespace pintle
