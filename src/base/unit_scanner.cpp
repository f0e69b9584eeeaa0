#include "base/unit_scanner.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/text/text_scanner.h"

namespace pintle {
namespace {

constexpr int kDeepest = 20;  // limit on nested parentheses in a unit

struct Exponent {
  int value = 1;
  std::size_t end = 0;
};

class UnitScanner {
 public:
  UnitScanner(std::string_view text, const IsName& is_variable, const IsAmbiguous& is_ambiguous)
      : text_(text), is_variable_(is_variable), is_ambiguous_(is_ambiguous) {}

  // A product of factors from `at`; `end` is just after the last factor that is a unit.
  UnitScan scan_product(std::size_t at, int depth) const {
    UnitScan result = scan_factor(at, depth);
    while (result.found && result.problem.empty()) {
      const std::size_t at_operator = skip_blanks(text_, result.end);
      const std::optional<OperatorAt> found = operator_at(text_, at_operator);
      if (!found || (found->symbol != '*' && found->symbol != '/')) break;
      const std::size_t at_factor = skip_blanks(text_, at_operator + found->length);
      const UnitScan next = scan_factor(at_factor, depth);
      if (!next.problem.empty()) return next;
      if (!next.found) break;
      if (const std::string_view symbol = symbol_at(text_, at_factor); !symbol.empty() && is_ambiguous_(symbol, *find_unit(symbol))) {
        fail(result, at_factor, fmt::format("{} is a parameter, and behind a unit it could be the unit {} as well", symbol, symbol));
        break;
      }
      join(result, next, found->symbol, at_operator);
    }
    return result;
  }

 private:
  UnitScan scan_factor(std::size_t at, int depth) const {
    UnitScan base = at < text_.size() && text_[at] == '(' ? scan_group(at, depth) : scan_symbol(at);
    if (!base.found || !base.problem.empty()) return base;
    return raised(base);
  }

  UnitScan scan_symbol(std::size_t at) const {
    UnitScan result;
    const std::string_view symbol = symbol_at(text_, at);
    const std::optional<Unit> unit = find_unit(symbol);
    const std::size_t end = at + symbol.size();
    if (!unit || is_variable_(symbol) || is_call_or_member(end)) return result;
    result.found = true;
    result.unit = *unit;
    result.end = end;
    return result;
  }

  // "min(" is a function and "m.angle" a joint's angle.
  bool is_call_or_member(std::size_t end) const {
    if (end >= text_.size()) return false;
    return text_[end] == '(' || (text_[end] == '.' && end + 1 < text_.size() && is_word_start(text_[end + 1]));
  }

  UnitScan scan_group(std::size_t at, int depth) const {
    if (depth >= kDeepest) return {};
    UnitScan inner = scan_product(skip_blanks(text_, at + 1), depth + 1);
    if (!inner.found || !inner.problem.empty()) return inner;
    const std::size_t close = skip_blanks(text_, inner.end);
    if (close >= text_.size() || text_[close] != ')') return {};
    inner.end = close + 1;
    return inner;
  }

  UnitScan raised(UnitScan base) const {
    const std::optional<Exponent> exponent = exponent_at(base.end);
    const std::size_t at = skip_blanks(text_, base.end);
    if (!exponent) {
      fail(base, at, "the exponent of a unit is a whole number from -20 to 20; a quantity with another one, as the stiffness of a contact in N/m^1.5, is given as a plain number in SI units");
      return base;
    }
    const std::optional<Dimension> dimension = power(base.unit.dimension, exponent->value);
    if (!dimension) {
      fail(base, at, "the exponents of this unit are too large");
      return base;
    }
    base.unit = {std::pow(base.unit.factor, exponent->value), *dimension};
    base.end = exponent->end;
    return base;
  }

  // The exponent after a factor: 1 if there is none, nothing if it is not a small whole number.
  std::optional<Exponent> exponent_at(std::size_t at) const {
    const std::string_view rest = text_.substr(at);
    if (rest.starts_with("\xC2\xB2")) return Exponent{2, at + 2};  // superscript two
    if (rest.starts_with("\xC2\xB3")) return Exponent{3, at + 2};  // superscript three
    std::size_t next = skip_blanks(text_, at);
    if (next >= text_.size() || text_[next] != '^') return Exponent{1, at};
    next = skip_blanks(text_, next + 1);
    const std::optional<OperatorAt> sign = operator_at(text_, next);
    if (sign && sign->symbol == '-') next = skip_blanks(text_, next + sign->length);
    const std::string_view digits = number_at(text_, next);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    const double value = to_number(digits);
    const std::size_t end = next + digits.size();
    const std::size_t behind = skip_blanks(text_, end);
    if (value > 20 || (behind < text_.size() && text_[behind] == '^')) return std::nullopt;
    return Exponent{static_cast<int>(value) * (sign ? -1 : 1), end};
  }

  static void join(UnitScan& result, const UnitScan& next, char symbol, std::size_t at_operator) {
    const bool divides = symbol == '/';
    const std::optional<Dimension> dimension = divides ? quotient(result.unit.dimension, next.unit.dimension)
                                                       : product(result.unit.dimension, next.unit.dimension);
    if (!dimension) {
      fail(result, at_operator, "the exponents of this unit are too large");
      return;
    }
    const double factor = divides ? result.unit.factor / next.unit.factor : result.unit.factor * next.unit.factor;
    result.unit = {factor, *dimension};
    result.end = next.end;
  }

  static void fail(UnitScan& scan, std::size_t at, std::string because) {
    scan.problem = std::move(because);
    scan.problem_offset = at;
  }

  std::string_view text_;
  const IsName& is_variable_;
  const IsAmbiguous& is_ambiguous_;
};

}  // namespace

UnitScan scan_unit(std::string_view text, std::size_t at, const IsName& is_variable, const IsAmbiguous& is_ambiguous) {
  return UnitScanner(text, is_variable, is_ambiguous).scan_product(at, 0);
}

}  // namespace pintle
