#include "base/tables/monotone_table.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <limits>
#include <utility>

namespace pintle {
namespace {

CubicCurve monotone_curve(std::vector<double> x, std::vector<double> y, bool odd) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("a table has at least two points, with as many values");
  if (odd && (x[0] != 0 || y[0] != 0)) throw std::invalid_argument("an odd table begins at 0 with 0");
  std::vector<double> slope = monotone_slopes(x, y, odd ? CurveEnds::kOdd : CurveEnds::kFree);
  return {std::move(x), std::move(y), std::move(slope)};
}

// Between the first and the last of neighbouring points with the value 0.
std::pair<double, double> zero_interval_of(const CubicCurve& curve, bool odd) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  const std::vector<double>&x = curve.x(), &y = curve.y();
  const std::size_t first = static_cast<std::size_t>(std::find(y.begin(), y.end(), 0.0) - y.begin());
  std::size_t last = first;
  while (last + 1 < y.size() && y[last + 1] == 0) ++last;
  if (first == last) return {0, 0};
  const double to = last + 1 == y.size() ? kUnbounded : x[last];
  return {odd ? -to : first == 0 ? -kUnbounded : x[first], to};
}

}  // namespace

MonotoneTable::MonotoneTable(std::vector<double> x, std::vector<double> y, Symmetry symmetry)
    : odd_(symmetry == Symmetry::kOdd), curve_(monotone_curve(std::move(x), std::move(y), odd_)), integral_at_zero_(curve_.integral(0)), zero_(zero_interval_of(curve_, odd_)) {}

double MonotoneTable::steepest_secant() const {
  const std::vector<double>&x = curve_.x(), &y = curve_.y();
  double steepest = 0;
  for (std::size_t i = 1; i < x.size(); ++i) steepest = std::max(steepest, (y[i] - y[i - 1]) / (x[i] - x[i - 1]));
  return steepest;
}

}  // namespace pintle
