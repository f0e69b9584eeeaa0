// Arithmetic expressions: parsed once into a safe program, evaluated with exact derivatives.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// Exponents of metre, kilogram, second, radian. `any` marks a bare number, which fits every dimension.
struct Dimension {
  std::array<std::int8_t, 4> exponents{0, 0, 0, 0};
  bool any = false;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// A number in SI units with its dimension.
struct Quantity {
  double si = 0;
  Dimension dimension;
};

/// A parsed expression of named variables. Immutable; cheap to copy (shares its program); never throws on evaluation:
/// a division by zero or a bad argument gives a NaN or infinity, which callers check.
class Expression {
 public:
  Expression();                           ///< the constant 0
  static Expression constant(double si);  ///< a constant

  const std::string& text() const { return text_; }                          ///< as the user wrote it
  const std::vector<std::string>& variables() const { return variables_; }   ///< e.g. {"t", "angle", "rate", "A.slide"}
  bool is_constant() const;
  /// A copy in which this variable is replaced by the constant `si`. The variable keeps its place in variables(), but the value passed for it is
  /// ignored.
  Expression substitute(std::string_view variable, double si) const;

  /// Value at `values` (one per variable, SI).
  double value(std::span<const double> values) const;
  /// Value and all first derivatives (exact). `gradient` has one entry per variable.
  double gradient(std::span<const double> values, std::span<double> gradient) const;
  /// A jump (a comparison, sign or step) replaced by a straight ramp: a share of the value above the jump plus the
  /// remaining share of the value below it.
  struct Ramp {
    std::size_t jump = 0;     // index of the jump, as returned by `jump_between`
    double share = 0;         // at margin `at`
    double slope = 0, at = 0; // share per unit of the margin
    double share_at(double margin) const { return share + slope * (margin - at); }
  };
  /// By how much the jump's argument exceeds its threshold (left side minus right side of a comparison).
  double margin(std::size_t jump, std::span<const double> values) const;
  /// A jump that lies between two points.
  std::optional<std::size_t> jump_between(std::span<const double> from, std::span<const double> to) const;
  /// Value and first derivatives with one jump replaced by a ramp, which continues beyond both sides.
  double gradient(std::span<const double> values, std::span<double> gradient, const Ramp& ramp) const;

  /// Number of kinks and jumps of the expression (min, max, abs, comparisons ..; two for a smoothstep).
  int n_switches() const;
  /// One value for each of them, which changes its sign there: positive on one side, negative or 0 on the other, and
  /// proportional to the distance of the arguments. With a ramp: positive where its share is outside 0 .. 1.
  void evaluate_switching_functions(std::span<const double> values, double* value, const Ramp* ramp = nullptr) const;
  /// Where switching function k changes its sign between two places, in ascending order, provided that it belongs to a table, the expression has one variable, and the
  /// table's argument is linear in it. None otherwise, or if there are more than `most` places.
  std::optional<std::vector<double>> kinks_of_table(std::size_t k, double low, double high, std::size_t most) const;
  /// Value, first and second derivative with respect to variable `index`, the others held (exact).
  std::array<double, 3> second_order(std::span<const double> values, std::size_t index) const;

  struct Program;

 private:
  friend class ExpressionParser;
  std::string text_ = "0";
  std::vector<std::string> variables_;
  std::shared_ptr<const Program> program_;
};

}  // namespace pintle
