// A function of one variable given by a table, as called by expressions. theory/tables
#pragma once

#include <optional>
#include <vector>

#include "base/tables/cubic_curve.h"

namespace pintle {

enum class TableInterpolation { kLinear, kMonotone, kSpline };
/// Beyond the ends of a table that is not periodic: constant, or linear with the slope at the end.
enum class TableOutside { kHold, kExtend };

/// Immutable.
class TableFunction {
 public:
  /// With the first two derivatives; at a knot, those of the piece after it.
  struct Values {
    double value, first, second;
  };

  /// At least two points, x strictly increasing. A periodic table spans at most its period; if it spans less, the first point of the next
  /// period follows the last one; if it spans all of it, the last value is that of the first point. Throws std::invalid_argument.
  TableFunction(std::vector<double> x, std::vector<double> y, TableInterpolation interpolation, TableOutside outside = TableOutside::kHold, std::optional<double> period = {});

  double value(double x) const;
  Values at(double x) const;

  /// Whether there are places at which the slope jumps, or the curvature jumps by much. theory/tables section 3
  bool has_kinks() const { return !kinks_.empty(); }
  /// The places between two values, ascending; none if there are more than `most`.
  std::optional<std::vector<double>> kinks_between(double low, double high, std::size_t most) const;
  /// A function that changes sign at each of them, with a slope of 1 or -1 there.
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
  CubicCurve curve_;           // for linear interpolation its slopes are not used
  std::vector<double> kinks_;  // ascending; of one period
};

}  // namespace pintle
