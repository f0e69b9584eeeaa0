#include "base/tables/cubic_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pintle {
namespace {

// The widths of the pieces and the slopes of the straight lines under them.
struct Pieces {
  std::vector<double> h, secant;
  Pieces(const std::vector<double>& x, const std::vector<double>& y) {
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      h.push_back(x[i + 1] - x[i]);
      secant.push_back((y[i + 1] - y[i]) / h[i]);
    }
  }
  std::size_t size() const { return h.size(); }
};

// Slope at x0 of the parabola through three points, from the secants of the piece at x0 and of the one beyond it.
double slope_at_end(double h0, double h1, double secant0, double secant1) {
  const double slope = ((2 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1);
  return slope * secant0 > 0 ? slope : 0;
}

// Slope of the parabola through a point and its neighbours, between pieces a and b; 0 where the points turn. theory/tables Eq. (2.2)
double slope_between(const Pieces& p, std::size_t a, std::size_t b) {
  return p.secant[a] * p.secant[b] > 0 ? (p.h[b] * p.secant[a] + p.h[a] * p.secant[b]) / (p.h[a] + p.h[b]) : 0;
}

// Limits the slopes to the circle of radius 3 secants, inside which a piece is monotone (Fritsch and Carlson, section 4). Slopes are
// only reduced, so that a piece stays inside when the next one changes the slope they share.
void limit_slopes(const Pieces& p, std::vector<double>& slope) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double size = std::hypot(slope[i], slope[i + 1]), most = 3 * std::abs(p.secant[i]);  // (2.3)
    if (!(size > most)) continue;
    slope[i] *= most / size;
    slope[i + 1] *= most / size;
  }
}

// The tridiagonal equations for the slopes of a spline. They are diagonally dominant.
struct SplineEquations {
  std::vector<double> below, diagonal, above, right;
  explicit SplineEquations(std::size_t n) : below(n), diagonal(n), above(n), right(n) {}
  // The second derivative is continuous at point i, between pieces a and b.
  void join(const Pieces& p, std::size_t i, std::size_t a, std::size_t b) {
    below[i] = 1 / p.h[a];
    above[i] = 1 / p.h[b];
    diagonal[i] = 2 * (below[i] + above[i]);                           // (2.4)
    right[i] = 3 * (p.secant[a] * below[i] + p.secant[b] * above[i]);  // (2.4)
  }
  // By Gaussian elimination.
  std::vector<double> solve(std::vector<double> x) const {
    const std::size_t n = x.size();
    std::vector<double> pivot = diagonal;
    for (std::size_t i = 1; i < n; ++i) {
      const double factor = below[i] / pivot[i - 1];
      pivot[i] -= factor * above[i - 1];
      x[i] -= factor * x[i - 1];
    }
    x[n - 1] /= pivot[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) x[i] = (x[i] - above[i] * x[i + 1]) / pivot[i];
    return x;
  }
};

// Continuity of the second derivative at every point of a closed curve: tridiagonal except for two corners, which the Sherman-Morrison
// formula takes into account.
std::vector<double> periodic_spline_slopes(const Pieces& p) {
  const std::size_t n = p.size();
  if (n == 1) return {0, 0};
  SplineEquations equations(n);
  for (std::size_t i = 0; i < n; ++i) equations.join(p, i, i == 0 ? n - 1 : i - 1, i);
  const double gamma = -equations.diagonal[0], wrap = 1 / p.h[n - 1];
  equations.diagonal[0] -= gamma;
  equations.diagonal[n - 1] -= wrap * wrap / gamma;
  std::vector<double> slope = equations.solve(equations.right), corner(n);
  corner[0] = gamma;
  corner[n - 1] = wrap;
  corner = equations.solve(corner);
  const double factor = (slope[0] + wrap / gamma * slope[n - 1]) / (1 + corner[0] + wrap / gamma * corner[n - 1]);
  for (std::size_t i = 0; i < n; ++i) slope[i] -= factor * corner[i];
  slope.push_back(slope[0]);
  return slope;
}

}  // namespace

CubicCurve::CubicCurve(std::vector<double> x, std::vector<double> y, std::vector<double> slope) : x_(std::move(x)), y_(std::move(y)), slope_(std::move(slope)), integral_(x_.size()) {
  if (x_.size() < 2 || x_.size() != y_.size() || x_.size() != slope_.size()) throw std::invalid_argument("a curve has at least two points, with as many values");
  for (std::size_t i = 1; i < x_.size(); ++i) {
    const double h = x_[i] - x_[i - 1];
    if (!(h > 0)) throw std::invalid_argument("the points of a curve rise");
    integral_[i] = integral_[i - 1] + 0.5 * h * (y_[i - 1] + y_[i]) + h * h / 12 * (slope_[i - 1] - slope_[i]);
  }
}

std::size_t CubicCurve::piece_at(double x) const {
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return static_cast<std::size_t>(above - x_.begin()) - 1;
}

double CubicCurve::value(double x) const {
  if (x <= x_.front()) return y_.front() + slope_.front() * (x - x_.front());
  if (x >= x_.back()) return y_.back() + slope_.back() * (x - x_.back());
  const std::size_t i = piece_at(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return y_[i] * (1 + 2 * s) * r * r + y_[i + 1] * (1 + 2 * r) * s * s + h * s * r * (slope_[i] * r - slope_[i + 1] * s);  // (2.1)
}

double CubicCurve::slope(double x) const {
  if (x <= x_.front()) return slope_.front();
  if (x >= x_.back()) return slope_.back();
  const std::size_t i = piece_at(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return 6 * s * r * (y_[i + 1] - y_[i]) / h + slope_[i] * r * (1 - 3 * s) + slope_[i + 1] * s * (3 * s - 2);  // (2.1)
}

double CubicCurve::curvature(double x) const {
  if (x < x_.front() || x >= x_.back()) return 0;
  const std::size_t i = piece_at(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h;
  return (6 * (1 - 2 * s) * (y_[i + 1] - y_[i]) / h + slope_[i] * (6 * s - 4) + slope_[i + 1] * (6 * s - 2)) / h;  // (2.1)
}

double CubicCurve::integral(double x) const {
  if (x <= x_.front()) return (x - x_.front()) * (y_.front() + 0.5 * slope_.front() * (x - x_.front()));
  if (x >= x_.back()) return integral_.back() + (x - x_.back()) * (y_.back() + 0.5 * slope_.back() * (x - x_.back()));
  const std::size_t i = piece_at(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  return integral_[i] + h * (y_[i] * (s - s3 + 0.5 * s4) + y_[i + 1] * (s3 - 0.5 * s4)) + h * h * (slope_[i] * (0.5 * s2 - 2 * s3 / 3 + 0.25 * s4) + slope_[i + 1] * (0.25 * s4 - s3 / 3));
}

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y, CurveEnds ends) {
  const Pieces p(x, y);
  const std::size_t n = p.size();
  std::vector<double> slope(n + 1);
  for (std::size_t i = 1; i < n; ++i) slope[i] = slope_between(p, i - 1, i);
  if (ends == CurveEnds::kPeriodic) {
    slope[0] = slope[n] = slope_between(p, n - 1, 0);
  } else {
    slope[0] = n == 1 || ends == CurveEnds::kOdd ? p.secant[0] : slope_at_end(p.h[0], p.h[1], p.secant[0], p.secant[1]);
    slope[n] = n == 1 ? p.secant[0] : slope_at_end(p.h[n - 1], p.h[n - 2], p.secant[n - 1], p.secant[n - 2]);
  }
  limit_slopes(p, slope);
  if (ends == CurveEnds::kPeriodic) slope[0] = slope[n] = std::abs(slope[0]) < std::abs(slope[n]) ? slope[0] : slope[n];
  return slope;
}

std::vector<double> spline_slopes(const std::vector<double>& x, const std::vector<double>& y, CurveEnds ends) {
  const Pieces p(x, y);
  if (ends == CurveEnds::kPeriodic) return periodic_spline_slopes(p);
  const std::size_t n = p.size();
  SplineEquations equations(n + 1);
  for (std::size_t i = 1; i < n; ++i) equations.join(p, i, i - 1, i);
  equations.diagonal[0] = equations.diagonal[n] = 2;
  equations.above[0] = equations.below[n] = 1;
  equations.right[0] = 3 * p.secant[0];      // (2.5)
  equations.right[n] = 3 * p.secant[n - 1];  // (2.5)
  return equations.solve(equations.right);
}

}  // namespace pintle
