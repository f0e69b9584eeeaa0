#include "base/expression/expression_problems.h"

#include <algorithm>
#include <array>

#include "base/expression/expression_ops.h"
#include "base/text/did_you_mean.h"
#include "base/text/text_scanner.h"
#include "base/text/utf8.h"
#include "base/units.h"

namespace pintle {
namespace {

struct Alias {
  std::string_view word;
  std::string_view unit;
};

// Common spellings of units that have another symbol here.
constexpr std::array<Alias, 20> kAliases{{
    {"sec", "s"},      {"second", "s"},    {"seconds", "s"},   {"hour", "h"},      {"hr", "h"},
    {"meter", "m"},    {"metre", "m"},     {"meters", "m"},    {"metres", "m"},    {"inch", "in"},
    {"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"},  {"radians", "rad"}, {"lbs", "lb"},
    {"kgs", "kg"},
    {"turn", "rev"},    {"turns", "rev"},
}};

std::string in_quotes(std::string_view text) {
  return '"' + printable(text) + '"';
}

// Common spellings of functions that have another name here.
constexpr std::array<Alias, 12> kFunctionAliases{{
    {"sinus", "sin"},
    {"cosinus", "cos"},
    {"tg", "tan"},
    {"arcsin", "asin"},
    {"arccos", "acos"},
    {"arctan", "atan"},
    {"ln", "log"},
    {"fabs", "abs"},
    {"power", "pow"},
    {"heaviside", "step"},
    {"sgn", "sign"},
    {"squareroot", "sqrt"},
}};

// "Nm" -> "N*m", if both halves are units of different kinds: "kgg" is a slip for "kg".
std::optional<std::string> split_unit(std::string_view word) {
  for (std::size_t i = 1; i < word.size(); ++i) {
    const std::optional<Unit> first = find_unit(word.substr(0, i));
    const std::optional<Unit> second = find_unit(word.substr(i));
    if (first && second && first->dimension != second->dimension)
      return std::string(word.substr(0, i)) + "*" + std::string(word.substr(i));
  }
  return std::nullopt;
}

// Whether the text before `at` ends with a number or a unit of one.
bool follows_number(std::string_view text, std::size_t at, const ParseScope& scope) {
  while (at > 0 && text[at - 1] == ' ') --at;
  std::size_t begin = at;
  while (begin > 0 && (is_word_part(text[begin - 1]) || text[begin - 1] == '.')) --begin;
  const std::string_view word = text.substr(begin, at - begin);
  return !word.empty() && (is_digit(word.front()) || (is_unit_symbol(word) && !is_known_name(word, scope)));
}

ParseProblem missing_operator(std::size_t at, std::string_view what) { return {at, in_quotes(what), "an operator is missing before it", "*" + std::string(what)}; }

ParseProblem missing_operator_of_unit(std::string_view text, std::size_t at, std::string_view unit, const ParseScope& scope) {
  const std::string name(unit);
  const std::string suggestion = follows_number(text, at, scope) ? "*" + name + " or /" + name : "*1 " + name;
  return {at, in_quotes(unit), "an operator is missing before it", suggestion};
}

ParseProblem unexpected_comma(std::string_view text, std::size_t at) {
  const bool between_digits = at > 0 && is_digit(text[at - 1]) && at + 1 < text.size() && is_digit(text[at + 1]);
  return {at, "a comma", "commas only separate the arguments of a function",
          between_digits ? "write decimals with a point" : "one expression for each value"};
}

// The first few names that are possible here.
std::string known_names(const ParseScope& scope) {
  constexpr std::size_t kShown = 8;
  std::vector<std::string> names;
  for (const auto& variable : scope.variables) names.push_back(variable.first);
  names.insert(names.end(), scope.constant_names.begin(), scope.constant_names.end());
  if (names.empty()) return "define it under [parameters]; functions are sin, cos, sqrt, if and others";
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) list += (i == 0 ? "" : ", ") + names[i];
  return "one of " + list + (names.size() > kShown ? ", ..." : "") + ", or define it under [parameters]";
}

}  // namespace

const ParseScope::Table* find_table(std::string_view word, const ParseScope& scope) {
  const auto it = std::find_if(scope.tables.begin(), scope.tables.end(), [&](const ParseScope::Table& table) { return table.name == word; });
  return it == scope.tables.end() ? nullptr : &*it;
}

DimensionProblem check_argument(const Operand& argument, const ParseScope::Table& table) {
  if (fits(argument.dimension, table.argument)) return {};
  return {to_words(argument.dimension), "table " + table.name + " is a function of " + to_words(table.argument), "what its x is: " + to_words(table.argument)};
}

bool is_known_name(std::string_view word, const ParseScope& scope) {
  const bool is_variable = std::any_of(scope.variables.begin(), scope.variables.end(),
                                       [&](const auto& variable) { return variable.first == word; });
  const auto& names = scope.constant_names;
  return is_variable || find_function(word) || find_table(word, scope) || word == "pi" || word == "e" ||
         std::find(names.begin(), names.end(), word) != names.end();
}

ParseProblem unexpected_after_operand(std::string_view text, std::size_t at, const ParseScope& scope) {
  const char c = text[at];
  const std::string_view character = character_at(text, at);
  if (c == ')') return {at, "a closing parenthesis", "no parenthesis is open here", "delete it, or open one with ("};
  if (c == ',') return unexpected_comma(text, at);
  if (c == '=') return {at, in_quotes("="), "an expression cannot be an equation", "compare with <= or >="};
  if (c == '(' || is_digit(c)) return missing_operator(at, c == '(' ? character : number_at(text, at));
  const std::string_view symbol = symbol_at(text, at);
  if (is_known_name(symbol, scope)) return missing_operator(at, symbol);
  if (is_unit_symbol(symbol)) return missing_operator_of_unit(text, at, symbol, scope);
  if (!symbol.empty() && is_word_start(c)) return unknown_name(symbol, at, scope);
  return {at, in_quotes(character), "this is not allowed in an expression", "+ - * / ^ ( ) < > <= >="};
}

ParseProblem no_operand(std::string_view text, std::size_t at) {
  constexpr std::string_view kWanted = "a number, a name or a parenthesis is missing here";
  if (at >= text.size())
    return {at, "the end of the text", std::string(kWanted), "a number, or delete what needs one"};
  const std::optional<OperatorAt> found = operator_at(text, at);
  if (!found)
    return {at, in_quotes(character_at(text, at)), std::string(kWanted), "a number, or delete what needs one"};
  const bool is_double_star = found->symbol == '*' && at > 0 && text[at - 1] == '*';
  return {at, in_quotes(text.substr(at, found->length)), std::string(kWanted),
          is_double_star ? "^ for a power" : "a number, or delete what needs one"};
}

// Whether the word names a force of a joint or motor: "rope.tension".
bool asks_for_a_force(std::string_view word) {
  constexpr std::array<std::string_view, 7> kForces{"force", "tension", "friction", "torque", "moment", "fx", "fy"};
  const std::size_t dot = word.rfind('.');
  return dot != std::string_view::npos && std::find(kForces.begin(), kForces.end(), word.substr(dot + 1)) != kForces.end();
}

ParseProblem unknown_name(std::string_view word, std::size_t at, const ParseScope& scope) {
  if (word == "t" && scope.variables.empty())
    return {at, in_quotes(word), "this is a constant: time may stand in forces, torques, and in the torque, force, speed or position of a motor",
            "a number; 1 t for a tonne"};
  if (word == "t" && scope.variables.size() == 1)
    return {at, in_quotes(word), "this is a function of " + scope.variables.front().first + ", in which time does not stand", scope.variables.front().first + "; 1 t for a tonne"};
  if (asks_for_a_force(word))
    return {at, in_quotes(word), "forces cannot be read, as they depend on what reads them", "what they come from: of a rope its stiffness times what its points are farther apart than it is long"};
  if (find_table(word, scope)) return {at, in_quotes(word), "a table is called as a function", std::string(word) + "(x)"};
  if (is_unit_symbol(word)) return {at, in_quotes(word), "a unit needs a number in front of it", "1 " + std::string(word)};
  std::vector<std::string_view> names(scope.constant_names.begin(), scope.constant_names.end());
  for (const auto& variable : scope.variables) names.push_back(variable.first);
  for (const ParseScope::Table& table : scope.tables) names.push_back(table.name);
  for (const FunctionInfo& function : function_catalog()) names.push_back(function.name);
  names.push_back("pi");
  const std::optional<std::string> guess = did_you_mean(word, names);
  const auto alias =
      std::find_if(kFunctionAliases.begin(), kFunctionAliases.end(), [&](const Alias& a) { return a.word == word; });
  if (alias != kFunctionAliases.end())
    return {at, in_quotes(word), "this name is not defined here", "did you mean " + in_quotes(alias->unit) + "?"};
  return {at, in_quotes(word), "this name is not defined here",
          guess ? "did you mean " + in_quotes(*guess) + "?" : known_names(scope)};
}

ParseProblem faulty_unit(const UnitScan& scan, std::string_view parameter) {
  if (parameter.empty()) return {scan.problem_offset, "", scan.problem, "units as in \"1 N*m*s/rad\""};
  return {scan.problem_offset, in_quotes(parameter), scan.problem,
          "(number and unit) in parentheses where the parameter is meant; another name for the parameter where the unit is meant"};
}

ParseProblem unknown_unit(std::string_view word, std::size_t at) {
  ParseProblem problem{at, in_quotes(word), "there is no unit with this symbol", ""};
  const auto alias = std::find_if(kAliases.begin(), kAliases.end(), [&](const Alias& a) { return a.word == word; });
  if (alias != kAliases.end()) {
    problem.suggestion = alias->unit;
  } else if (const std::optional<std::string> product = split_unit(word)) {
    problem.suggestion = *product;
  } else if (const std::optional<std::string> guess = did_you_mean(word, unit_symbols())) {
    problem.suggestion = "did you mean " + in_quotes(*guess) + "?";
  } else {
    problem.suggestion = "units are made of m, mm, kg, s, N, rad, deg and others, joined by * and /";
  }
  return problem;
}

}  // namespace pintle
