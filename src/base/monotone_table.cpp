#include "base/monotone_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pintle {
namespace {

// Slope at x0 of the parabola through three points, from the secants of the piece at x0 and of the one beyond it.
double slope_at_end(double h0, double h1, double secant0, double secant1) {
  const double slope = ((2 * h0 + h1) * secant0 - h0 * secant1) / (h0 + h1);
  return slope * secant0 > 0 ? slope : 0;
}

}  // namespace

MonotoneTable::MonotoneTable(std::vector<double> x, std::vector<double> y, Symmetry symmetry)
    : odd_(symmetry == Symmetry::kOdd), x_(std::move(x)), y_(std::move(y)), slope_(x_.size()), integral_(x_.size()) {
  if (x_.size() < 2 || x_.size() != y_.size()) throw std::invalid_argument("a table has at least two points, with as many values");
  for (std::size_t i = 1; i < x_.size(); ++i)
    if (!(x_[i] > x_[i - 1])) throw std::invalid_argument("the points of a table rise");
  if (odd_ && (x_[0] != 0 || y_[0] != 0)) throw std::invalid_argument("an odd table begins at 0 with 0");
  find_slopes();
  limit_slopes();
  for (std::size_t i = 1; i < x_.size(); ++i) {
    const double h = x_[i] - x_[i - 1];
    integral_[i] = integral_[i - 1] + 0.5 * h * (y_[i - 1] + y_[i]) + h * h / 12 * (slope_[i - 1] - slope_[i]);
  }
  integral_at_zero_ = integral_from_start(0);
}

// That of the parabola through a point and its neighbours; 0 where the points turn.
void MonotoneTable::find_slopes() {
  const std::size_t last = x_.size() - 1;
  const auto h = [&](std::size_t i) { return x_[i + 1] - x_[i]; };
  const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / h(i); };
  for (std::size_t i = 1; i < last; ++i)
    slope_[i] = secant(i - 1) * secant(i) > 0 ? (h(i) * secant(i - 1) + h(i - 1) * secant(i)) / (h(i - 1) + h(i)) : 0;
  slope_[0] = last == 1 || odd_ ? secant(0) : slope_at_end(h(0), h(1), secant(0), secant(1));
  slope_[last] = last == 1 ? secant(0) : slope_at_end(h(last - 1), h(last - 2), secant(last - 1), secant(last - 2));
}

// Into the circle of radius 3 secants, inside which a piece is monotone (Fritsch and Carlson, section 4). Slopes only become smaller, so
// that a piece stays inside when the next one changes the slope they share.
void MonotoneTable::limit_slopes() {
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    const double secant = (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
    const double size = std::hypot(slope_[i], slope_[i + 1]);
    if (!(size > 3 * std::abs(secant))) continue;
    slope_[i] *= 3 * std::abs(secant) / size;
    slope_[i + 1] *= 3 * std::abs(secant) / size;
  }
}

std::size_t MonotoneTable::interval_of(double x) const {
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return static_cast<std::size_t>(above - x_.begin()) - 1;
}

double MonotoneTable::value(double x) const {
  if (odd_ && x < 0) return -value(-x);
  if (x <= x_.front()) return y_.front() + slope_.front() * (x - x_.front());
  if (x >= x_.back()) return y_.back() + slope_.back() * (x - x_.back());
  const std::size_t i = interval_of(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return y_[i] * (1 + 2 * s) * r * r + y_[i + 1] * (1 + 2 * r) * s * s + h * s * r * (slope_[i] * r - slope_[i + 1] * s);
}

double MonotoneTable::slope(double x) const {
  if (odd_ && x < 0) return slope(-x);
  if (x <= x_.front()) return slope_.front();
  if (x >= x_.back()) return slope_.back();
  const std::size_t i = interval_of(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, r = 1 - s;
  return 6 * s * r * (y_[i + 1] - y_[i]) / h + slope_[i] * r * (1 - 3 * s) + slope_[i + 1] * s * (3 * s - 2);
}

double MonotoneTable::integral_from_start(double x) const {
  if (x <= x_.front()) return (x - x_.front()) * (y_.front() + 0.5 * slope_.front() * (x - x_.front()));
  if (x >= x_.back()) return integral_.back() + (x - x_.back()) * (y_.back() + 0.5 * slope_.back() * (x - x_.back()));
  const std::size_t i = interval_of(x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h, s2 = s * s, s3 = s2 * s, s4 = s3 * s;
  return integral_[i] + h * (y_[i] * (s - s3 + 0.5 * s4) + y_[i + 1] * (s3 - 0.5 * s4)) +
         h * h * (slope_[i] * (0.5 * s2 - 2 * s3 / 3 + 0.25 * s4) + slope_[i + 1] * (0.25 * s4 - s3 / 3));
}

double MonotoneTable::integral(double x) const {
  return integral_from_start(odd_ ? std::abs(x) : x) - integral_at_zero_;
}

double MonotoneTable::steepest_secant() const {
  double steepest = 0;
  for (std::size_t i = 1; i < x_.size(); ++i) steepest = std::max(steepest, (y_[i] - y_[i - 1]) / (x_[i] - x_[i - 1]));
  return steepest;
}

}  // namespace pintle
