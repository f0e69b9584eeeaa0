#include "base/expression/expression_dimensions.h"

#include <cmath>
#include <optional>

#include "base/units.h"

namespace pintle {
namespace {

Operand joined(const Operand& a, const Operand& b, const Dimension& dimension, bool is_number) {
  return {dimension, is_number, a.varies || b.varies, 0, a.offset};
}

// Whether this bare number is a plain factor of `other`, rather than a coefficient with units of its own.
bool is_plain_factor(const Operand& bare, const Operand& other) {
  return bare.is_number && !other.varies;
}

CombinedOperand product_or_quotient(const Operand& a, const Operand& b, bool divides) {
  if (a.dimension.any && b.dimension.any) return {joined(a, b, kBareNumber, a.is_number && b.is_number), {}};
  const bool is_open = (a.dimension.any && !is_plain_factor(a, b)) || (b.dimension.any && !is_plain_factor(b, a));
  if (is_open) return {joined(a, b, kBareNumber, false), {}};
  const Dimension left = a.dimension.any ? kPureNumber : a.dimension;
  const Dimension right = b.dimension.any ? kPureNumber : b.dimension;
  const std::optional<Dimension> dimension = divides ? quotient(left, right) : product(left, right);
  if (dimension) return {joined(a, b, *dimension, false), {}};
  return {a, {to_words(left), "the exponents of its units become too large here", "smaller powers"}};
}

// The dimension to the power `exponent`; nothing if metre, kilogram or second get a fractional or huge exponent.
std::optional<Dimension> raised(const Dimension& dimension, double exponent) {
  Dimension result;
  for (std::size_t i = 0; i < dimension.exponents.size(); ++i) {
    const double wanted = dimension.exponents[i] * exponent;
    const double whole = std::round(wanted);
    const bool is_whole = std::abs(wanted - whole) < 1e-9;
    const bool is_angle = i == 3;
    if (!is_angle && !(is_whole && std::abs(whole) <= 100)) return std::nullopt;
    if (is_whole && std::abs(whole) <= 100) result.exponents[i] = static_cast<std::int8_t>(whole);
  }
  return result;
}

CombinedOperand raised(const Operand& a, double exponent, const std::string& found) {
  const std::optional<Dimension> dimension = raised(a.dimension, exponent);
  if (dimension) return {{*dimension, false, a.varies, 0, a.offset}, {}};
  if (a.varies) return {{kBareNumber, false, true, 0, a.offset}, {}};
  return {a,
          {found, "its units would get a fractional or huge exponent",
           "divide by a quantity of the same kind first, such as (x/1 m)"}};
}

}  // namespace

DimensionProblem check_pure(const Operand& operand, const std::string& name) {
  if (is_pure(operand.dimension)) return {};
  DimensionProblem problem{to_words(operand.dimension), name + " needs a number or an angle",
                           "divide by a quantity of the same kind, such as (x/1 m)"};
  if (fits(operand.dimension, kTime)) problem.suggestion = "multiply the time by an angular speed, such as 1 rad/s";
  return problem;
}

CombinedOperand alike(const Operand& a, const Operand& b, const std::string& between) {
  if (!fits(a.dimension, b.dimension)) {
    const std::string found = to_words(a.dimension) + " " + between + " " + to_words(b.dimension);
    return {a, {found, "both must be of the same kind", "quantities of one kind; a bare number fits every kind"}};
  }
  const Dimension& dimension = a.dimension.any ? b.dimension : a.dimension;
  return {joined(a, b, dimension, a.is_number && b.is_number), {}};
}

CombinedOperand product_of(const Operand& a, const Operand& b) {
  return product_or_quotient(a, b, false);
}
CombinedOperand quotient_of(const Operand& a, const Operand& b) {
  return product_or_quotient(a, b, true);
}

CombinedOperand power_of(const Operand& a, const Operand& exponent) {
  const DimensionProblem problem = check_pure(exponent, "an exponent");
  if (!problem.because.empty()) return {exponent, problem};
  if (a.dimension.any) return {joined(a, exponent, kBareNumber, a.is_number), {}};
  if (is_pure(a.dimension)) return {joined(a, exponent, kPureNumber, false), {}};
  const std::string found = to_words(a.dimension) + " to a power";
  if (exponent.varies)
    return {exponent,
            {found, "the exponent of a quantity with units must be a constant",
             "divide by a quantity of the same kind first, such as (x/1 m)"}};
  if (std::isnan(exponent.constant)) return {{kBareNumber, false, a.varies, 0, a.offset}, {}};
  return raised(a, exponent.constant, found);
}

CombinedOperand square_root_of(const Operand& a) {
  if (a.dimension.any) return {a, {}};
  return raised(a, 0.5, "the square root of " + to_words(a.dimension));
}

}  // namespace pintle
