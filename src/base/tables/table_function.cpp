#include "base/tables/table_function.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace pintle {
namespace {

CubicCurve curve_through(std::vector<double> x, std::vector<double> y, TableInterpolation interpolation, bool periodic) {
  const CurveEnds ends = periodic ? CurveEnds::kPeriodic : CurveEnds::kFree;
  std::vector<double> slope = interpolation == TableInterpolation::kSpline ? spline_slopes(x, y, ends) : monotone_slopes(x, y, ends);
  return {std::move(x), std::move(y), std::move(slope)};
}

}  // namespace

TableFunction::TableFunction(std::vector<double> x, std::vector<double> y, TableInterpolation interpolation, TableOutside outside, std::optional<double> period)
    : interpolation_(interpolation), outside_(outside), period_(period) {
  if (x.size() < 2 || x.size() != y.size()) throw std::invalid_argument("a table has at least two points, with as many values");
  if (period) {
    const double end = x.front() + *period;
    const double rounding = 1e-9 * *period;
    if (x.back() > end + rounding) throw std::invalid_argument("a periodic table spans no more than its period");
    if (x.back() > end - rounding) {
      x.back() = end;
      y.back() = y.front();
    } else {
      x.push_back(end);
      y.push_back(y.front());
    }
  }
  curve_ = curve_through(std::move(x), std::move(y), interpolation, period.has_value());
  find_kinks();
}

double TableFunction::secant(std::size_t piece) const {
  const std::vector<double>&x = curve_.x(), &y = curve_.y();
  return (y[piece + 1] - y[piece]) / (x[piece + 1] - x[piece]);
}

// Whether the curvature jumps there by so much that a step across it misses the curve by a share of the table's range: |jump| h^2/8, with the shorter piece.
bool TableFunction::bends_at(std::size_t left, std::size_t right) const {
  constexpr double kBend = 1e-2;  // as a fraction of the range. With four points a run to 1e-5 takes 64 steps if steps end there, and 1387 if they do not; with 400 on five waves of a sine 1417 and 827: 0.4 and 1.4e-3 of the range
  const auto [least, most] = std::minmax_element(curve_.y().begin(), curve_.y().end());
  const auto width = [this](std::size_t piece) { return curve_.x()[piece + 1] - curve_.x()[piece]; };
  const auto slope = [this](std::size_t point) { return curve_.slope(curve_.x()[point]); };
  const double before = (2 * slope(left) + 4 * slope(left + 1) - 6 * secant(left)) / width(left);
  const double behind = (6 * secant(right) - 4 * slope(right) - 2 * slope(right + 1)) / width(right);
  const double h = std::min(width(left), width(right));
  return std::abs(behind - before) * h * h / 8 > kBend * (*most - *least);
}

void TableFunction::find_kinks() {
  const std::vector<double>& x = curve_.x();
  const std::size_t last = x.size() - 1;
  const bool linear = interpolation_ == TableInterpolation::kLinear, held = !period_ && outside_ == TableOutside::kHold;
  const double first_slope = linear ? secant(0) : curve_.slope(x.front()), last_slope = linear ? secant(last - 1) : curve_.slope(x.back());
  const bool monotone = interpolation_ == TableInterpolation::kMonotone;
  const bool seam = period_ && (linear ? first_slope != last_slope : monotone && bends_at(last - 1, 0));
  if (held ? first_slope != 0 : seam) kinks_.push_back(x.front());
  for (std::size_t i = 1; i < last; ++i)
    if (linear ? secant(i - 1) != secant(i) : monotone && bends_at(i - 1, i)) kinks_.push_back(x[i]);
  if (held && last_slope != 0) kinks_.push_back(x.back());
}

double TableFunction::in_period(double x) const {
  return period_ ? x - *period_ * std::floor((x - curve_.x().front()) / *period_) : x;  // (1.1)
}

bool TableFunction::is_held(double x) const {
  return !period_ && outside_ == TableOutside::kHold && (x < curve_.x().front() || x >= curve_.x().back());
}

double TableFunction::value(double x) const {
  const double at = in_period(x);
  if (std::isnan(at)) return at;
  if (is_held(at)) return at < curve_.x().front() ? curve_.y().front() : curve_.y().back();
  if (interpolation_ != TableInterpolation::kLinear) return curve_.value(at);
  const std::size_t i = curve_.piece_at(at);
  return curve_.y()[i] + secant(i) * (at - curve_.x()[i]);  // (1.2)
}

TableFunction::Values TableFunction::at(double x) const {
  const double at = in_period(x);
  if (std::isnan(at)) return {at, at, at};
  if (is_held(at)) return {value(x), 0, 0};
  if (interpolation_ == TableInterpolation::kLinear) return {value(x), secant(curve_.piece_at(at)), 0};
  return {curve_.value(at), curve_.slope(at), curve_.curvature(at)};
}

double TableFunction::switching(double x) const {
  const auto n = static_cast<std::ptrdiff_t>(kinks_.size());
  const double turns = period_ ? std::floor((x - kinks_.front()) / *period_) : 0;
  const double at = period_ ? x - turns * *period_ : x;
  std::ptrdiff_t i = std::upper_bound(kinks_.begin(), kinks_.end(), at) - kinks_.begin() - 1;
  if (period_) i = std::max<std::ptrdiff_t>(i, 0);
  const bool odd = std::fmod(std::abs(turns * static_cast<double>(n) + static_cast<double>(i)), 2) == 1;
  const auto kink = [this](std::ptrdiff_t k) { return kinks_[static_cast<std::size_t>(k)]; };
  const bool before = i < 0, beyond = !period_ && i == n - 1;
  double distance = 0;
  if (before || beyond) {
    distance = std::abs(at - kink(before ? 0 : i));
  } else {
    const double left = kink(i), right = i + 1 < n ? kink(i + 1) : kink(0) + *period_;
    distance = std::max(0.0, (at - left) * (right - at) / (right - left));  // (3.1)
  }
  return odd ? -distance : distance;
}

std::optional<std::vector<double>> TableFunction::kinks_between(double low, double high, std::size_t most) const {
  std::vector<double> all;
  if (kinks_.empty()) return all;
  const double first = period_ ? std::floor((low - kinks_.front()) / *period_) : 0, last = period_ ? std::floor((high - kinks_.front()) / *period_) : 0;
  if ((last - first + 1) * static_cast<double>(kinks_.size()) > static_cast<double>(most) + 2 * static_cast<double>(kinks_.size())) return {};
  for (double turn = first; turn <= last; ++turn)
    for (const double kink : kinks_)
      if (const double at = period_ ? kink + turn * *period_ : kink; at > low && at < high) all.push_back(at);
  if (all.size() > most) return {};
  return all;
}

}  // namespace pintle
