// A function of one variable through given points, by cubic pieces that rise and fall only where the points do (base/tables/cubic_curve.h). The
// function and its slope are continuous, the curvature jumps at the points. Beyond the ends it is linear.
#pragma once

#include <utility>
#include <vector>

#include "base/tables/cubic_curve.h"

namespace pintle {

class MonotoneTable {
 public:
  /// Whether a table that begins at x = 0, f = 0 is extended by f(-x) = -f(x).
  enum class Symmetry { kNone, kOdd };

  MonotoneTable() = default;
  /// At least two points, x strictly increasing. Throws std::invalid_argument if this is violated, or if an odd table does not begin at (0, 0).
  MonotoneTable(std::vector<double> x, std::vector<double> y, Symmetry symmetry = Symmetry::kNone);

  double value(double x) const { return odd_ && x < 0 ? -curve_.value(-x) : curve_.value(x); }
  double slope(double x) const { return curve_.slope(odd_ && x < 0 ? -x : x); }
  /// From 0 to x, exact for the pieces: no quadrature.
  double integral(double x) const { return curve_.integral(odd_ && x < 0 ? -x : x) - integral_at_zero_; }
  /// The interval in which it is 0, as where a pad is not touched; unbounded at an end where it is 0. Its length is 0 where the table only passes through 0 or stays above or below.
  std::pair<double, double> zero_interval() const { return zero_; }
  /// The largest slope of the straight lines between neighbouring points.
  double steepest_secant() const;

 private:
  bool odd_ = false;
  CubicCurve curve_;
  double integral_at_zero_ = 0;
  std::pair<double, double> zero_{0, 0};
};

}  // namespace pintle
