#include "bearings/duty.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

double length(const std::array<double, 2>& f) { return std::hypot(f[0], f[1]); }

/// From one row to the next, x from 0 to 1.
class Interval {
 public:
  Interval(const DutyRow& from, const DutyRow& to) : from_(from), to_(to), h_(to.t - from.t), turned_(to.angle - from.angle) {}

  /// d(angle)/dx. Eq. (1.1)
  double slope(double x) const { return h_ * from_.rate * (1 - x) * (1 - 3 * x) + h_ * to_.rate * x * (3 * x - 2) + 6 * turned_ * x * (1 - x); }

  /// Integral of |F|^power |d(angle)| over the interval. Eq. (1.3)
  double load_integral(double power) const {
    const std::array<double, 4> ends = monotone_parts();
    double sum = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) sum += part(ends[i], ends[i + 1], power);
    return sum;
  }

 private:
  /// 0, 1, and where the angle turns round between them: the slope is a + b x + c x^2.
  std::array<double, 4> monotone_parts() const {
    const double a = slope(0), c = 2 * (slope(0) - 2 * slope(0.5) + slope(1)), b = slope(1) - a - c;
    std::array<double, 4> ends{0, 0, 0, 1};
    const double root = b * b - 4 * a * c;
    if (root < 0) return ends;
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    const auto inside = [](double numerator, double denominator) {
      const double x = numerator / denominator;
      return x > 0 && x < 1 ? x : 0;
    };
    ends[1] = inside(q, c);
    ends[2] = inside(a, q);
    std::sort(ends.begin(), ends.end());
    return ends;
  }

  /// Gauss's rule of three points, exact for the path.
  double part(double begin, double end, double power) const {
    static const double kOff = std::sqrt(0.6);
    const double half = 0.5 * (end - begin), middle = 0.5 * (begin + end);
    double sum = 0;
    for (const auto& [place, weight] : {std::pair(-kOff, 5.0 / 9), std::pair(0.0, 8.0 / 9), std::pair(kOff, 5.0 / 9)}) {
      const double x = middle + half * place;
      const double load = length({from_.force[0] + x * (to_.force[0] - from_.force[0]), from_.force[1] + x * (to_.force[1] - from_.force[1])});
      sum += weight * std::pow(load, power) * std::abs(slope(x));
    }
    return half * sum;
  }

  const DutyRow &from_, &to_;
  double h_, turned_;
};

}  // namespace

double Duty::load_integral(double power) const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) sum += Interval(rows_[i], rows_[i + 1]).load_integral(power);
  return sum;
}

double Duty::equivalent_load(double exponent) const { return std::pow(load_integral(exponent) / path(), 1 / exponent); }

double Duty::swing() const {
  const auto [least, largest] = std::minmax_element(rows_.begin(), rows_.end(), [](const DutyRow& a, const DutyRow& b) { return a.angle < b.angle; });
  return rows_.empty() ? 0 : largest->angle - least->angle;
}

double Duty::peak_rate() const {
  double peak = 0;
  for (const DutyRow& row : rows_) peak = std::max(peak, std::abs(row.rate));
  return peak;
}

double Duty::peak_power() const {
  double peak = 0;
  for (const DutyRow& row : rows_) peak = std::max(peak, length(row.force) * std::abs(row.rate));
  return peak;
}

Duty Duty::thinned() const {
  std::vector<DutyRow> kept;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (i % 2 == 0 || i + 1 == rows_.size()) kept.push_back(rows_[i]);
  return Duty(std::move(kept));
}

}  // namespace pintle
