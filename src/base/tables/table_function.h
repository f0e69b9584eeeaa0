// A function of one variable that a table gives, as expressions call it. theory/tables
#pragma once

#include <optional>
#include <vector>

#include "base/tables/cubic_curve.h"

namespace pintle {

enum class TableInterpolation { kLinear, kMonotone, kSpline };
/// Beyond the ends of a table that is not periodic: its value there, or straight on with its slope there.
enum class TableOutside { kHold, kExtend };

/// Immutable.
class TableFunction {
 public:
  /// With the first two derivatives. At a knot those of the piece behind it.
  struct Values {
    double value, first, second;
  };

  /// At least two points, x strictly rising. A periodic table spans no more than the period; where it spans less, the first point of the
  /// next period follows the last one; where it spans all of it, the last value is that of the first point. Throws std::invalid_argument.
  TableFunction(std::vector<double> x, std::vector<double> y, TableInterpolation interpolation, TableOutside outside = TableOutside::kHold, std::optional<double> period = {});

  double value(double x) const;
  Values at(double x) const;

  /// Whether there are places at which the slope jumps, or the curvature by much. theory/tables section 3
  bool has_kinks() const { return !kinks_.empty(); }
  /// Those between two places, ascending; none where there are more than `most`.
  std::optional<std::vector<double>> kinks_between(double low, double high, std::size_t most) const;
  /// A number that changes its sign at each of them, with a slope of 1 or -1 there.
  double switching(double x) const;

 private:
  double in_period(double x) const;
  bool is_held(double x) const;
  double secant(std::size_t piece) const;
  void find_kinks();
  bool bends_at(std::size_t left, std::size_t right) const;  // between these pieces

  TableInterpolation interpolation_;
  TableOutside outside_;
  std::optional<double> period_;
  CubicCurve curve_;           // a linear one has no use for its slopes
  std::vector<double> kinks_;  // rising; of one period
};

}  // namespace pintle
