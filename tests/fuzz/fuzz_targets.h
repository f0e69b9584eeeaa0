// What the fuzzers try, and what the tests replay: each takes any bytes and answers with nothing, or with the promise
// that was broken. A crash, a hang or a foreign exception is a broken promise too.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expression_parser.h"
#include "base/units.h"
#include "io/document.h"
#include "io/writers.h"
#include "pintle/read_model.h"
#include "results/series_csv.h"
#include "results/summary_json.h"

namespace pintle::fuzz {

/// Every complaint stands somewhere, has a reason, and can be printed.
inline std::string faults_of(const InputError& error, std::string_view text) {
  if (error.complaints().empty()) return "an InputError without complaints";
  for (const Complaint& complaint : error.complaints()) {
    const std::string printed = to_text(complaint);
    if (complaint.because.empty()) return "no reason: " + printed;
    if (complaint.place.line < 1 || complaint.place.column < 1) return "no place: " + printed;
    if (static_cast<std::size_t>(complaint.place.line) > text.size() + 1) return "a place after the end: " + printed;
  }
  return {};
}

inline std::string read_as_model(std::string_view text, std::string_view name) {
  try {
    parse_model(text, name);
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

/// TOML: read as a model; as a tree it goes to JSON and back; its formatted text has the same tree and formats to
/// itself.
inline std::string model_toml(std::string_view text) {
  if (std::string fault = read_as_model(text, "x.toml"); !fault.empty()) return fault;
  try {
    const Document document = parse_toml(text, "x.toml");
    check_text(text, "x.toml");
    const Document twin = parse_json(to_json(document), "x.json");
    if (!same_tree(document.root, twin.root)) return "another tree in JSON:\n" + to_json(document);
    const std::string once = format_toml(text, "x.toml");
    if (!same_tree(document.root, parse_toml(once, "x.toml").root)) return "another tree when formatted:\n" + once;
    if (format_toml(once, "x.toml") != once) return "formatting again changes it:\n" + once;
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

inline std::string model_json(std::string_view text) {
  if (std::string fault = read_as_model(text, "x.json"); !fault.empty()) return fault;
  try {
    check_text(text, "x.json");
    const Document document = parse_json(text, "x.json");
    if (!same_tree(document.root, parse_toml(to_toml(document), "x.toml").root))
      return "another tree in TOML:\n" + to_toml(document);
  } catch (const InputError& error) {
    return faults_of(error, text);
  }
  return {};
}

inline ParseScope expression_scope() {
  const auto constant = [](std::string_view name) -> std::optional<Quantity> {
    if (name == "crank") return Quantity{0.1, kLength};
    if (name == "broken") return Quantity{std::nan(""), kMass};
    return std::nullopt;
  };
  return {constant, {"crank"}, {{"t", kTime}, {"x", kBareNumber}, {"a-b.angle", kAngle}}};
}

inline bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// What is accepted has the same value and first derivatives by every way of asking.
inline std::string expression(std::string_view text) {
  const auto parsed = parse_expression(text, expression_scope());
  if (const auto* problem = std::get_if<ParseProblem>(&parsed)) {
    if (problem->offset > text.size()) return "a problem after the end";
    return problem->because.empty() ? "a problem without a reason" : "";
  }
  const Expression& f = std::get<ParsedExpression>(parsed).expression;
  const std::vector<double> values(f.variables().size(), 0.7);
  std::vector<double> gradient(values.size());
  if (!same(f.value(values), f.gradient(values, gradient))) return "two values";
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!same(f.second_order(values, i)[1], gradient[i])) return "two derivatives";
  return {};
}

/// The name of a unit that is read is read as the same unit (but for names without numerator, "1/m/s", and
/// products of larger exponents than may be written).
inline constexpr int kLargestUnitExponent = 20;
inline std::string unit(std::string_view text) {
  const std::optional<Unit> found = parse_unit(text);
  if (!found) return {};
  if (std::isnan(found->factor)) return "a factor that is no number";
  const std::string name = to_unit_text(found->dimension);
  const std::optional<Unit> again = parse_unit(name);
  const auto large = [](std::int8_t exponent) { return std::abs(exponent) > kLargestUnitExponent; };
  const bool readable = std::none_of(found->dimension.exponents.begin(), found->dimension.exponents.end(), large);
  if (readable && !name.starts_with('1') && (!again || !fits(again->dimension, found->dimension)))
    return fmt::format("its name {} is not read back", name);
  return {};
}

inline std::string series(std::string_view text) {
  try {
    Trajectory trajectory;
    read_series(text, "series.csv", trajectory);
  } catch (const FileError& error) {
    if (std::string_view(error.what()).empty()) return "an empty message";
  }
  return {};
}

inline std::string summary(std::string_view text) {
  try {
    is_summary(text);
    const Summary found = parse_summary(text, "summary.json");
    const std::string once = summary_json(found.run.trajectory, found.run.stamp);
    summary_text(found.run.trajectory, found.run.stamp);
    if (once.empty()) return "an empty summary";
  } catch (const FileError& error) {
    if (std::string_view(error.what()).empty()) return "an empty message";
  }
  return {};
}

struct Target {
  const char* name;
  std::string (*run)(std::string_view);
};

inline constexpr std::array<Target, 6> kTargets{{{"model_toml", model_toml},
                                                 {"model_json", model_json},
                                                 {"expression", expression},
                                                 {"unit", unit},
                                                 {"series", series},
                                                 {"summary", summary}}};

}  // namespace pintle::fuzz
