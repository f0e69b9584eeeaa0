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

}  // namespace

MonotoneTable::MonotoneTable(std::vector<double> x, std::vector<double> y, Symmetry symmetry)
    : odd_(symmetry == Symmetry::kOdd), curve_(monotone_curve(std::move(x), std::move(y), odd_)), integral_at_zero_(curve_.integral(0)) {}

std::pair<double, double> MonotoneTable::play() const {
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  const std::vector<double>&x = curve_.x(), &y = curve_.y();
  std::size_t first = 0;
  while (first < y.size() && y[first] != 0) ++first;
  std::size_t last = first;
  while (last + 1 < y.size() && y[last + 1] == 0) ++last;
  if (last >= y.size() || first == last) return {kBeyond, -kBeyond};
  const double from = first == 0 ? -kBeyond : x[first], to = last + 1 == y.size() ? kBeyond : x[last];
  return odd_ ? std::pair(-to, to) : std::pair(from, to);
}

double MonotoneTable::steepest_secant() const {
  const std::vector<double>&x = curve_.x(), &y = curve_.y();
  double steepest = 0;
  for (std::size_t i = 1; i < x.size(); ++i) steepest = std::max(steepest, (y[i] - y[i - 1]) / (x[i] - x[i - 1]));
  return steepest;
}

}  // namespace pintle
