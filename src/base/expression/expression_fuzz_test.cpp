// Random texts: the parser answers any input, and what it accepts evaluates and differentiates without trouble.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/expression/expression_parser.h"
#include "base/units.h"

namespace pintle {
namespace {

constexpr int kTexts = 20000;

// The same numbers on every machine (splitmix64).
class Dice {
 public:
  std::size_t roll(std::size_t sides) {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<std::size_t>((z ^ (z >> 31U)) % sides);
  }

 private:
  std::uint64_t state_ = 20080803;
};

ParseScope fuzz_scope() {
  const auto constant = [](std::string_view name) -> std::optional<Quantity> {
    if (name == "crank") return Quantity{0.1, kLength};
    if (name == "broken") return Quantity{std::nan(""), kMass};
    return std::nullopt;
  };
  const auto curve = std::make_shared<const TableFunction>(std::vector<double>{0, 1, 3}, std::vector<double>{2, 0, 2}, TableInterpolation::kLinear, TableOutside::kHold, 3);
  return {constant, {"crank"}, {{"t", kTime}, {"x", kBareNumber}, {"a-b.angle", kAngle}}, {{"curve", kBareNumber, kLength, curve}}};
}

std::string tokens_at_random(Dice& dice) {
  constexpr std::array<const char*, 50> kTokens{
      "1",    "2.5",   "3e8",  "0",    ".",        "t",    "x",           "crank",   "a-b.angle", "broken",
      "sin(", "sqrt(", "pow(", "min(", "if(",      "abs(", "atan2(",      "log(",    "step(",     "(",
      ")",    ")",     ",",    "+",    "-",        "*",    "/",           "^",       "<",         ">=",
      "m",    "mm",    "N",    "s",    "deg",      "rpm",  "kg",          " ",       " ",         "^2",
      "^-1",  "pi",    "e",    "=",    "\xC2\xB7", "\xC2", "smoothstep(", "\xC2\xB0",       "curve(", "curve"};
  std::string text;
  for (std::size_t n = 1 + dice.roll(24); n > 0; --n) text += kTokens[dice.roll(kTokens.size())];
  return text;
}

std::string bytes_at_random(Dice& dice) {
  std::string text;
  for (std::size_t n = dice.roll(60); n > 0; --n) text += static_cast<char>(dice.roll(256));
  return text;
}

// An expression with correct grammar, though seldom with correct units.
std::string tree_at_random(Dice& dice, int depth) {
  constexpr std::array<const char*, 8> kLeaves{"1", "2.5 mm", "t", "x", "3", "a-b.angle", "crank", "0.5"};
  constexpr std::array<const char*, 8> kJoins{" + ", "-", "*", "/", "^", " < ", "*", " - "};
  constexpr std::array<const char*, 6> kCalls{"sin(", "abs(", "exp(", "sqrt(", "step(", "tanh("};
  if (depth == 0 || dice.roll(6) == 0) return kLeaves[dice.roll(kLeaves.size())];
  const std::string inner = tree_at_random(dice, depth - 1);
  if (dice.roll(4) == 0) return kCalls[dice.roll(kCalls.size())] + inner + ")";
  return "(" + inner + kJoins[dice.roll(kJoins.size())] + tree_at_random(dice, depth - 1) + ")";
}

// Returns whether the text was accepted.
bool digest(const std::string& text) {
  const auto parsed = parse_expression(text, fuzz_scope());
  if (const auto* problem = std::get_if<ParseProblem>(&parsed)) {
    EXPECT_LE(problem->offset, text.size()) << text;
    EXPECT_FALSE(problem->because.empty()) << text;
    return false;
  }
  const Expression& f = std::get<ParsedExpression>(parsed).expression;
  const std::vector<double> values(f.variables().size(), 0.7);
  std::vector<double> gradient(values.size());
  const double value = f.value(values);
  const double again = f.gradient(values, gradient);
  EXPECT_TRUE(value == again || (std::isnan(value) && std::isnan(again))) << text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double first = f.second_order(values, i)[1];
    EXPECT_TRUE(first == gradient[i] || (std::isnan(first) && std::isnan(gradient[i]))) << text;
  }
  return true;
}

TEST(ExpressionFuzz, NothingCrashesOrHangs) {
  Dice dice;
  int n_accepted = 0;
  for (int i = 0; i < kTexts; ++i) {
    const std::size_t kind = dice.roll(4);
    const std::string text = kind == 0   ? bytes_at_random(dice)
                             : kind == 1 ? tree_at_random(dice, 5)
                                         : tokens_at_random(dice);
    n_accepted += digest(text) ? 1 : 0;
    parse_unit(text);
  }
  EXPECT_GT(n_accepted, kTexts / 50);
}

TEST(ExpressionFuzz, LongRepetitions) {
  for (const char* part :
       {"(", "-", "1 m*(", "m*(", "2^", "sin(", "1 m^", "((m*", "1*(m)/(", "if(t,", "1 N/m", "1+(", "\xC2"}) {
    std::string text;
    while (text.size() + 8 < kLongestExpression) text += part;
    EXPECT_FALSE(digest(text)) << part;
    EXPECT_FALSE(digest("1 " + text)) << part;
  }
}

}  // namespace
}  // namespace pintle
