// A function of one variable through given points, by cubic pieces with given slopes at the points (Hermite form), and two ways to find
// such slopes. Beyond the ends it is linear. theory/tables section 2
#pragma once

#include <cstddef>
#include <vector>

namespace pintle {

/// What continues the curve beyond the first and the last point when slopes are found.
enum class CurveEnds {
  kFree,      // nothing
  kOdd,       // f(-x) = -f(x): the first point is (0, 0)
  kPeriodic,  // the curve repeats: the last point is the first one of the next period
};

class CubicCurve {
 public:
  CubicCurve() = default;
  /// At least two points, x strictly increasing, with the same number of values and slopes.
  CubicCurve(std::vector<double> x, std::vector<double> y, std::vector<double> slope);

  double value(double x) const;
  double slope(double x) const;
  double curvature(double x) const;  ///< the second derivative; at a point, that of the piece after it
  /// From the first point to x, exact for the pieces: no quadrature.
  double integral(double x) const;

  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }
  /// The piece that contains x; beyond the ends the first or the last one.
  std::size_t piece_at(double x) const;

 private:
  std::vector<double> x_, y_, slope_, integral_;  // at the points; integral from the first point
};

/// Slopes with which the curve rises and falls only where the points do, and its slope is continuous. F. N. Fritsch and R. E. Carlson,
/// Monotone piecewise cubic interpolation, SIAM J. Numerical Analysis 17 (1980) 238-246.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y, CurveEnds ends);

/// Slopes with which the second derivative is continuous, and zero at free ends: a natural or a periodic spline. C. de Boor, A Practical
/// Guide to Splines, Springer 2001, chapter IV.
std::vector<double> spline_slopes(const std::vector<double>& x, const std::vector<double>& y, CurveEnds ends);

}  // namespace pintle
