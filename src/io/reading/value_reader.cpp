// Single values: numbers with units, words, lists, expressions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "base/text/text_scanner.h"
#include "base/units.h"
#include "io/reading/record.h"
#include "io/text.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// A unit that depends on other keys, such as N/m^contact_exponent, is in brackets in the meaning.
std::string plain_example(const KeySpec& spec, double si) {
  const std::size_t open = spec.meaning.find('['), close = spec.meaning.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return "a plain number such as 0.5";
  const std::string number = si != 0 ? fmt::format("{:.6g}, ", si) : "";
  return number + "a plain number in SI, without its unit " + spec.meaning.substr(open + 1, close - open - 1);
}

// si: the value found, with an unsuitable unit.
std::string example_of(const KeySpec& spec, double si = 0) {
  if (spec.unit.empty()) return plain_example(spec, si);
  if (spec.unit == "any") return "a number or a string such as \"25 mm\"";
  return "a number in SI, or a string such as \"1 " + spec.unit + "\"";
}

std::string short_number(double number) {
  return fmt::format("{}", number);
}

// " mm", to stand after a number; empty where the key has no unit of its own.
std::string unit_after_number(const KeySpec& spec) { return spec.unit.empty() || spec.unit == "any" ? "" : " " + spec.unit; }

// A negative number or plain quantity with the other sign, in the unit in which it was given.
std::string reversed(const Node& node, double number, const std::string& unit) {
  const std::string* text = node.string();
  const std::size_t minus = text != nullptr ? text->find('-') : std::string::npos;
  if (minus == std::string::npos) return short_number(-number) + unit;
  return text->substr(skip_blanks(*text, minus + 1));
}

std::string range_example(double number, const Node& node, const KeySpec& spec) {
  const bool needs_positive = spec.minimum && *spec.minimum == 0 && number <= 0;
  const std::string unit = unit_after_number(spec);
  if (needs_positive && number < 0 && !unit.empty()) return "reverse the sign: \"" + reversed(node, number, unit) + "\"";
  const double* usual = spec.fallback ? spec.fallback->real() : nullptr;
  const bool below_one = (spec.maximum && *spec.maximum <= 1) || (usual != nullptr && *usual < 1);
  if (needs_positive) return unit.empty() ? below_one ? "0.01" : "1" : "a small positive value, such as \"1e-3" + unit + "\"";
  if (spec.minimum && spec.maximum) return short_number(*spec.minimum) + " to " + short_number(*spec.maximum);
  return spec.minimum ? short_number(*spec.minimum) + " or more" : example_of(spec);
}

// A number with or without a unit: anything else is computed.
bool is_plain_quantity(const Node& node) {
  if (node.string() == nullptr) return true;
  const std::string_view text = *node.string();
  std::size_t at = skip_blanks(text, 0);
  if (at < text.size() && (text[at] == '-' || text[at] == '+')) ++at;
  const std::string_view number = number_at(text, at);
  return !number.empty() && parse_unit(text.substr(skip_blanks(text, at + number.size())));
}

std::string list_example(const KeySpec& spec) {
  if (spec.per_component) return "one number for each linear gap component, or one for all";
  if (!spec.fallback || spec.fallback->array() == nullptr) return "[0, 0]";
  std::string text;
  for (const Node& item : *spec.fallback->array())
    text += (text.empty() ? "" : ", ") + (item.real() != nullptr ? short_number(*item.real()) : describe(item));
  return "[" + text + "]";
}

// Whether the text contains this word at a place for which counts(position behind it) holds.
template <class Counts>
bool has_word(std::string_view text, std::string_view word, const Counts& counts) {
  const auto in_word = [text](std::size_t at) { return at < text.size() && (is_word_part(text[at]) || text[at] == '.'); };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t behind = at + word.size();
    if (!in_word(behind) && (at == 0 || !in_word(at - 1)) && counts(behind)) return true;
  }
  return false;
}

// Whether the text contains one of these variables.
bool mentions(std::string_view text, const std::vector<std::string>& variables) {
  return std::any_of(variables.begin(), variables.end(), [text](const std::string& variable) { return has_word(text, variable, [](std::size_t) { return true; }); });
}
bool mentions(const Node& node, const std::vector<std::string>& variables) { return node.string() != nullptr && mentions(*node.string(), variables); }

// A remark on a parameter that has the name of a unit and may have been meant, as in "60 t*W^2"; empty: there is none.
std::string unit_or_parameter(const Node& node, const std::vector<std::string>& parameters) {
  for (const std::string& name : parameters)
    if (mentions(node, {name}) && parse_unit(name)) return fmt::format("; behind a number, {0} is a unit and not the parameter {0}: parentheses keep them apart, as in (2 kg)*{0}", name);
  return {};
}

}  // namespace

std::string range_problem(double number, const KeySpec& spec) {
  const std::string unit = unit_after_number(spec);
  const bool feeds = spec.key.find("damping") != std::string::npos || spec.key.find("stiffness") != std::string::npos;
  if (feeds && number < 0 && spec.minimum) return "a negative " + spec.key + " feeds energy into the mechanism";
  if (spec.minimum && spec.minimum_exclusive && number <= *spec.minimum) {
    return "this must be greater than " + short_number(*spec.minimum) + unit;
  }
  if (spec.minimum && number < *spec.minimum) return "this must be at least " + short_number(*spec.minimum) + unit;
  if (spec.maximum && number > *spec.maximum) return "this must be at most " + short_number(*spec.maximum) + unit;
  return {};
}

bool mentions_frequency(std::string_view text) {
  const auto is_unit = [text](std::size_t behind) {
    const std::size_t next = skip_blanks(text, behind);
    return next == text.size() || text[next] != '(';
  };
  return mentions(text, {"Hz", "kHz"}) || has_word(text, "min", is_unit);
}

bool RecordReader::is_frequency(std::string_view text) const {
  if (!(mentions_frequency(text) || mentions(text, frequencies)) || mentions(text, {"pi", "rad", "deg", "rev", "turn"})) return false;
  const auto parsed = parse_quantity(text, scope);
  const Quantity* quantity = std::get_if<Quantity>(&parsed);
  return quantity == nullptr || quantity->dimension.exponents[3] == 0;  // not a speed in rad/s multiplied by minutes
}

std::optional<std::string> RecordReader::frequency_for_speed_error(std::string_view text, const Dimension& wanted) const {
  if (wanted != kAngularSpeed || !is_frequency(text)) return std::nullopt;
  return "a rotational speed is expected here; a frequency in Hz or 1/min would count radians, not turns";
}

void RecordReader::complain(const ParseProblem& problem, const Node& node, const std::string& path) {
  const Spot spot = complaints_.document().inside(node, problem.offset);
  complaints_.add(spot, path, problem.found.empty() ? describe(node) : problem.found, problem.because,
                  problem.suggestion);
}

std::optional<Quantity> RecordReader::read_quantity(const Node& node, const std::string& path) {
  if (const std::int64_t* integer = node.integer()) return Quantity{static_cast<double>(*integer), kBareNumber};
  if (const double* real = node.real()) return Quantity{*real, kBareNumber};
  const std::string* string = node.string();
  if (string == nullptr) {
    complaints_.add(node.spot, path, describe(node), "a number is expected here",
                    "a number, or a string such as \"25 mm\"");
    return std::nullopt;
  }
  auto result = parse_quantity(*string, scope);
  if (const ParseProblem* problem = std::get_if<ParseProblem>(&result)) {
    complain(*problem, node, path);
    return std::nullopt;
  }
  const Quantity quantity = std::get<Quantity>(result);
  if (std::isnan(quantity.si)) return std::nullopt;  // uses a constant that was complained about
  if (std::isfinite(quantity.si)) return quantity;
  complaints_.add(node.spot, path, describe(node), "this does not give a finite number",
                  "check for a division by 0, or a root or logarithm outside its range");
  return std::nullopt;
}

std::optional<std::string> RecordReader::wrong_dimension(const Dimension& found, const KeySpec& spec) const {
  return check_dimension(found, spec.dimension);
}

bool RecordReader::in_range(double number, const Node& node, const KeySpec& spec, const std::string& path) {
  std::string problem = range_problem(number, spec);
  if (problem.empty()) return true;
  std::string suggestion = range_example(number, node, spec);
  if (!is_plain_quantity(node)) {
    problem += fmt::format(", and is {:.6g}{}", number, unit_after_number(spec));
    suggestion = "check the signs and units of what it is computed from; an angle without a unit is in radians";
  }
  complaints_.add(node.spot, path, describe(node), std::move(problem), std::move(suggestion));
  return false;
}

std::optional<double> RecordReader::read_number(const Node& node, const KeySpec& spec, const std::string& path) {
  const bool is_number = node.integer() != nullptr || node.real() != nullptr || node.string() != nullptr;
  if (!is_number) {
    complaints_.add(node.spot, path, describe(node), "a number is expected here", example_of(spec));
    return std::nullopt;
  }
  const std::optional<Quantity> quantity = read_quantity(node, path);
  if (!quantity) return std::nullopt;
  if (std::optional<std::string> problem = wrong_dimension(quantity->dimension, spec)) {
    complaints_.add(node.spot, path, describe(node), *problem + unit_or_parameter(node, scope.constant_names), example_of(spec, quantity->si));
    return std::nullopt;
  }
  if (!in_range(quantity->si, node, spec, path)) return std::nullopt;
  return quantity->si;
}

std::optional<Value> RecordReader::read_value(const Node& node, const KeySpec& spec, const std::string& path) {
  if (const std::string* text = node.string(); text != nullptr && !is_function_of_time(node, spec))
    if (auto problem = frequency_for_speed_error(*text, spec.dimension)) {
      complaints_.add(node.spot, path, describe(node), std::move(*problem), kSpeedExample);
      return std::nullopt;
    }
  Value value;
  bool good = false;
  switch (spec.type) {
    case ValueType::kInteger:
      good = read_integer(node, spec, path, value);
      break;
    case ValueType::kText:
    case ValueType::kWord:
    case ValueType::kMarkerName:
    case ValueType::kJointName:
    case ValueType::kTableName:
      good = read_word(node, spec, path, value);
      break;
    case ValueType::kWords:
    case ValueType::kMarkerNames:
      good = read_words(node, spec, path, value);
      break;
    case ValueType::kQuantity:
      good = is_function_of_time(node, spec) ? read_function_of_time(node, spec, path, value) : read_numbers(node, spec, path, value);
      break;
    case ValueType::kNumber:
    case ValueType::kQuantities:
      good = read_numbers(node, spec, path, value);
      break;
    case ValueType::kExpression:
      good = read_expression(node, spec, path, value);
      break;
    case ValueType::kExpressions:
      good = read_list(node, spec, path, value);
      break;
    case ValueType::kTruth:
      good = read_truth(node, spec, path, value);
      break;
    case ValueType::kColumn:
      good = node.string() != nullptr ? read_word(node, spec, path, value) : read_integer(node, spec, path, value);
      break;
    case ValueType::kMarker:
      break;  // markers have tables of their own: read_marker
  }
  if (!good) return std::nullopt;
  return value;
}

bool RecordReader::read_integer(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  if (node.integer() == nullptr) {
    complaints_.add(node.spot, path, describe(node), "a whole number is expected here", spec.key + " = 1");
    return false;
  }
  value.numbers.push_back(static_cast<double>(*node.integer()));
  return in_range(value.numbers.back(), node, spec, path);
}

bool RecordReader::read_truth(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  if (node.truth() == nullptr) {
    complaints_.add(node.spot, path, describe(node), "true or false is expected here, without quotes", spec.key + " = true");
    return false;
  }
  value.numbers.push_back(*node.truth() ? 1 : 0);
  return true;
}

std::string RecordReader::other_key_that_allows(const KeySpec& spec, const std::string& word) const {
  const auto has_word = [&word](const auto& key) { return std::find(key.words.begin(), key.words.end(), word) != key.words.end(); };
  for (const KeySpec& key : table_->keys)
    if (key.key != spec.key && has_word(key)) return key.key;
  for (const LawInfo& law : law_catalog())
    if (table_->law_keys && key_of(law.role) == spec.key)
      for (const KeyInfo& key : law.keys)
        if (has_word(key)) return std::string(key.key);
  return "";
}

bool RecordReader::read_word(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  const std::string* word = node.string();
  if (word == nullptr) {
    complaints_.add(node.spot, path, describe(node), "a string is expected here",
                    spec.words.empty() ? "text in quotes" : "one of " + joined(spec.words));
    return false;
  }
  for (const auto& [synonym, allowed] : spec.synonyms)
    if (*word == synonym) {
      value.words.push_back(allowed);
      return true;
    }
  if (!spec.words.empty() && std::find(spec.words.begin(), spec.words.end(), *word) == spec.words.end()) {
    const auto meant = std::find_if(spec.meant.begin(), spec.meant.end(), [word](const auto& entry) { return entry.first == *word; });
    const std::string near = meant != spec.meant.end() ? meant->second : complaints_.nearest(*word, spec.words);
    const std::string other = near.empty() ? other_key_that_allows(spec, *word) : "";
    complaints_.add(node.spot, path, in_quotes(*word), "it is none of " + joined(spec.words),
                    other.empty() ? advice(near, spec.words) : other + " = " + in_quotes(*word));
    return false;
  }
  value.words.push_back(*word);
  return true;
}

bool RecordReader::read_words(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  const Array* list = node.array();
  if (list == nullptr || (spec.count != 0 && list->size() != spec.count)) {
    const std::string wanted = spec.count == 0 ? "a list of" : "a list of " + std::to_string(spec.count);
    const std::string* alone = node.string();
    const std::string one = alone != nullptr && std::find(spec.words.begin(), spec.words.end(), *alone) != spec.words.end() ? *alone : spec.words.empty() ? "text" : spec.words.front();
    complaints_.add(node.spot, path, describe(node), wanted + " strings is expected here", spec.type == ValueType::kMarkerNames ? "[\"ground.A\", \"crank.A\"]" : "[" + in_quotes(one) + "]");
    return false;
  }
  bool good = true;
  for (const Node& item : *list) good = read_word(item, spec, path, value) && good;
  return good;
}

bool RecordReader::read_numbers(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  const Array* list = node.array();
  const bool wants_list = spec.type == ValueType::kQuantities;
  if (!wants_list && (list == nullptr || !spec.per_component)) {
    const std::optional<double> number = read_number(node, spec, path);
    value.numbers.push_back(number.value_or(0));
    return number.has_value();
  }
  const bool any_length = wants_list && spec.count == 0;
  if (list == nullptr || (any_length ? list->empty() : list->size() != spec.count)) {
    const std::string wanted = any_length ? "a list of numbers" : "a list of " + std::to_string(spec.count) + (spec.count == 1 ? " number" : " numbers");
    complaints_.add(node.spot, path, describe(node), wanted + " is expected here", any_length ? "[" + (spec.unit.empty() ? std::string("0.5") : "\"1 " + spec.unit + "\"") + "]" : list_example(spec));
    return false;
  }
  bool good = true;
  for (const Node& item : *list) {
    const std::optional<double> number = read_number(item, spec, path);
    value.numbers.push_back(number.value_or(0));
    good = good && number.has_value();
  }
  return good;
}

void RecordReader::set_variables(const KeySpec& spec, std::string_view text) {
  scope.variables.clear();
  for (const std::string& variable : spec.variables) {
    if (variable == "t") scope.variables.emplace_back("t", kTime);
    if (variable == "x") scope.variables.emplace_back("x", kLength);
    if (variable == "angle") scope.variables.emplace_back("angle", kAngle);
    if (variable == "slide") scope.variables.emplace_back("slide", kLength);
    if (variable == "angle_rate") scope.variables.emplace_back("angle_rate", kAngularSpeed);
    if (variable == "slide_rate") scope.variables.emplace_back("slide_rate", kLinearSpeed);
    if (variable == "stroke") scope.variables.emplace_back("stroke", kLength);
    if (variable == "stroke_rate") scope.variables.emplace_back("stroke_rate", kLinearSpeed);
    if (variable == "joints" && joint_variables) joint_variables(text, scope.variables);
  }
  const bool has_rate = std::find(spec.variables.begin(), spec.variables.end(), "rate") != spec.variables.end();
  const bool slides = std::find(spec.variables.begin(), spec.variables.end(), "slide") != spec.variables.end();
  if (has_rate) scope.variables.emplace_back("rate", slides ? kLinearSpeed : kAngularSpeed);
}

bool RecordReader::read_expression(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  const std::string* text = node.string();
  if (text == nullptr) {
    const std::optional<double> number = read_number(node, spec, path);
    value.expressions.push_back(Expression::constant(number.value_or(0)));
    return number.has_value();
  }
  set_variables(spec, *text);
  auto result = parse_expression(*text, scope);
  scope.variables.clear();
  if (const ParseProblem* problem = std::get_if<ParseProblem>(&result)) {
    complain(*problem, node, path);
    return false;
  }
  ParsedExpression& parsed = std::get<ParsedExpression>(result);
  if (std::optional<std::string> problem = wrong_dimension(parsed.dimension, spec)) {
    complaints_.add(node.spot, path, describe(node), std::move(*problem), "an expression in " + spec.unit);
    return false;
  }
  if (parsed.expression.variables() == std::vector<std::string>{"t"}) {
    const double start = 0;
    if (!std::isfinite(parsed.expression.value(std::span(&start, 1)))) {
      complaints_.add(node.spot, path, describe(node), "this is not a finite number at t = 0",
                      "if(t > 0, ..., 0) where it is not defined");
      return false;
    }
  }
  value.expressions.push_back(std::move(parsed.expression));
  return true;
}

// Whatever is not a number is taken for a function, so that its complaint says which variables are available.
bool RecordReader::is_function_of_time(const Node& node, const KeySpec& spec) const {
  if (spec.variables.empty() || node.string() == nullptr) return false;
  return mentions(node, spec.variables) || std::holds_alternative<ParseProblem>(parse_quantity(*node.string(), scope));
}

// An expression that is in the key's range at the start, if it is one of t.
bool RecordReader::read_function_of_time(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  if (!read_expression(node, spec, path, value)) return false;
  if (value.expressions.back().variables() != std::vector<std::string>{"t"}) return true;
  const double start = 0;
  return in_range(value.expressions.back().value(std::span(&start, 1)), node, spec, path);
}

bool RecordReader::read_list(const Node& node, const KeySpec& spec, const std::string& path, Value& value) {
  const Array* list = node.array();
  if (list == nullptr || list->size() != spec.count) {
    complaints_.add(node.spot, path, describe(node),
                    "a list of " + std::to_string(spec.count) + " numbers or expressions is expected here",
                    "[0, \"-10 " + spec.unit + "\"]");
    return false;
  }
  bool good = true;
  for (const Node& item : *list) good = read_expression(item, spec, path, value) && good;
  return good;
}

}  // namespace pintle
