// A function of one variable through given points, by cubic pieces that rise and fall only where the points do. F. N. Fritsch and R. E.
// Carlson, Monotone piecewise cubic interpolation, SIAM J. Numerical Analysis 17 (1980) 238-246. The function and its slope are
// continuous, the curvature jumps at the points. Beyond the ends it is straight.
#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

class MonotoneTable {
 public:
  /// Whether f(-x) = -f(x) completes a table that begins at x = 0, f = 0.
  enum class Symmetry { kNone, kOdd };

  MonotoneTable() = default;
  /// At least two points, x strictly rising. Throws std::invalid_argument where that is not so, or an odd table does not begin at (0, 0).
  MonotoneTable(std::vector<double> x, std::vector<double> y, Symmetry symmetry = Symmetry::kNone);

  double value(double x) const;
  double slope(double x) const;
  /// From 0 to x, of the pieces themselves: no quadrature.
  double integral(double x) const;
  /// The largest slope of the straight lines between neighbouring points.
  double steepest_secant() const;

 private:
  void find_slopes();
  void limit_slopes();
  std::size_t interval_of(double x) const;
  double integral_from_start(double x) const;

  bool odd_ = false;
  std::vector<double> x_, y_, slope_, integral_;  // at the points; integral from the first of them
  double integral_at_zero_ = 0;
};

}  // namespace pintle
