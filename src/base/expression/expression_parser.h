// From text to expression: "2*crank + 5 mm", "5 N*m - 0.1*rate".
//
// A unit belongs to the number, the pi or the closing parenthesis before it and binds more tightly than any operator,
// so that "1/2 m" is 1/(2 m). It continues as long as units follow * or /: "3 N*s/m". A variable is never a unit. For a
// constant with the symbol of a unit, "2 h" is two hours and "2*h" twice the constant; "2 mm/h" is refused, but "N*m" is not, even if m is a mass.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/tables/table_function.h"
#include "pintle/expression.h"

namespace pintle {

/// Limits on the length of a text and on its nesting.
inline constexpr std::size_t kLongestExpression = 4096;
inline constexpr int kDeepestExpression = 200;

/// The names that an expression may use in addition to functions, units, pi and e.
struct ParseScope {
  /// A constant by name. A NaN stands for a constant about which a complaint has been made already: expressions of it
  /// are NaN of any dimension, without further problems.
  std::function<std::optional<Quantity>(std::string_view)> constant;
  std::vector<std::string> constant_names;  // all of them, whether their values are known yet or not
  /// Variables; a name consists of letters, digits and _, or has one dot, before which - is allowed too:
  /// "hip-pin.angle". A dotted name takes precedence over the meaning of its parts.
  std::vector<std::pair<std::string, Dimension>> variables;
  /// Tables that are called as functions: NAME(x).
  struct Table {
    std::string name;
    Dimension argument, result;
    std::shared_ptr<const TableFunction> function;
  };
  std::vector<Table> tables{};
};

/// What is wrong, at a byte offset in the text. `found` and `suggestion` may be empty.
struct ParseProblem {
  std::size_t offset = 0;
  std::string found;
  std::string because;
  std::string suggestion;
};

struct ParsedExpression {
  Expression expression;  // its variables: those that occur, in order of appearance
  Dimension dimension;
};

std::variant<ParsedExpression, ParseProblem> parse_expression(std::string_view text, const ParseScope& scope);

/// The same without variables: a constant.
std::variant<Quantity, ParseProblem> parse_quantity(std::string_view text, const ParseScope& scope = {});

/// Words that cannot be the name of a parameter or a table: functions, pi, e and the time t.
bool is_reserved_name(std::string_view word);
/// Whether this could be written as a name in an expression: a letter or _, then letters, digits, _.
bool is_identifier(std::string_view word);

}  // namespace pintle
