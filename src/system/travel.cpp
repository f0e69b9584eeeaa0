#include "system/travel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace pintle {
namespace {

constexpr int kStretches = 32;          // at least, in a duration: no oscillation is passed over that makes less than some hundred turns
constexpr double kResolved = 1e-14;     // of the speed: what the last coefficients of a resolved curve may be
constexpr double kRounding = 1e-9;      // of it: a rest below that no halving makes smaller is rounding
constexpr double kShortest = 1e-13;     // of the duration: a stretch about a jump
constexpr std::size_t kMost = 200'000;  // stretches, beyond which none is halved

// The sum of coefficients times Chebyshev polynomials at x in [-1, 1] (Clenshaw).
template <std::size_t n>
double chebyshev_sum(const std::array<double, n>& coefficients, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t k = n - 1; k > 0; --k) b2 = std::exchange(b1, coefficients[k] + 2 * x * b1 - b2);
  return coefficients[0] + x * b1 - b2;
}

}  // namespace

Travel::Travel(Expression speed, double duration) : speed_(std::move(speed)), duration_(duration) {
  for (int i = 0; i < kStretches; ++i)
    for (const double x : sample(duration_ * i / kStretches, duration_ * (i + 1) / kStretches))
      if (std::isfinite(x)) largest_ = std::max(largest_, std::abs(x));
  for (int i = 0; i < kStretches; ++i) add(duration_ * i / kStretches, duration_ * (i + 1) / kStretches, INFINITY, stretches_);
}

double Travel::Stretch::at(double t) const { return before + chebyshev_sum(coefficients, 2 * (t - begin) / (end - begin) - 1); }

double Travel::at(double t) const {
  const Stretch& last = stretches_.back();
  if (t > last.end) {
    std::vector<Stretch> beyond{integrate(last.begin, last.end, last.before, sample(last.begin, last.end))};
    add(last.end, t, INFINITY, beyond);
    return beyond.back().at(t);
  }
  const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), t, [](double at, const Stretch& stretch) { return at < stretch.begin; });
  return (after == stretches_.begin() ? *after : *(after - 1)).at(t);
}

// Chebyshev coefficients of the speed, through its values at the extrema of the last polynomial.
Travel::Values Travel::sample(double begin, double end) const {
  constexpr int n = kDegree;
  Values value, out;
  for (int i = 0; i <= n; ++i) {
    const std::array<double, 1> t{begin + 0.5 * (end - begin) * (1 + std::cos(std::numbers::pi * i / n))};
    value[static_cast<std::size_t>(i)] = speed_.value(std::span(t).first(speed_.variables().size()));
  }
  for (int k = 0; k <= n; ++k) {
    double sum = 0.5 * (value.front() + (k % 2 == 0 ? 1 : -1) * value.back());
    for (int i = 1; i < n; ++i) sum += value[static_cast<std::size_t>(i)] * std::cos(std::numbers::pi * i * k / n);
    out[static_cast<std::size_t>(k)] = (k == 0 || k == n ? 1.0 : 2.0) / n * sum;
  }
  return out;
}

// Halves what a polynomial does not resolve.
void Travel::add(double begin, double end, double rest_before, std::vector<Stretch>& to) const {
  const Values c = sample(begin, end);
  const double rest = std::max({std::abs(c[kDegree]), std::abs(c[kDegree - 1]), std::abs(c[kDegree - 2])});
  const double size = std::accumulate(c.begin(), c.end(), largest_, [](double sum, double x) { return sum + std::abs(x); });
  const bool rounding = rest > 0.5 * rest_before && rest < kRounding * size;
  if (!std::isfinite(size) || rest <= kResolved * size || rounding || end - begin < kShortest * duration_ || to.size() > kMost) {
    to.push_back(integrate(begin, end, to.empty() ? 0 : to.back().at(begin), c));
    return;
  }
  const double middle = 0.5 * (begin + end);
  add(begin, middle, rest, to);
  add(middle, end, rest, to);
}

// The integral of T_k is T_{k+1} / (2 (k + 1)) - T_{k-1} / (2 (k - 1)), and T_1 for k = 0, T_2 / 4 for k = 1.
Travel::Stretch Travel::integrate(double begin, double end, double before, const Values& of_speed) {
  Stretch stretch{begin, end, before, {}};
  const double half = 0.5 * (end - begin);
  const auto speed = [&of_speed](std::size_t k) { return k < of_speed.size() ? of_speed[k] : 0; };
  for (std::size_t k = 1; k < stretch.coefficients.size(); ++k)
    stretch.coefficients[k] = half * ((k == 1 ? 2 : 1) * speed(k - 1) - speed(k + 1)) / (2 * static_cast<double>(k));
  stretch.coefficients[0] = -chebyshev_sum(stretch.coefficients, -1);
  return stretch;
}

}  // namespace pintle
