#include "system/speed_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/constants.h"

namespace pintle {
namespace {

constexpr int kPanels = 32;             // least number of panels on a duration: all of 200 pulses of 1/300 of it are seen; with 16, two in three
constexpr std::size_t kMost = 200'000;  // with more panels than this none is halved: 34 MB and 1.6 s for a speed that no polynomial follows
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();  // error allowed in a panel, as a fraction of the whole distance; with half of it 5000 turns of a sine
                                                                          // take half as many panels again, with twice as much 1 in 100 fewer

// The sum of coefficients times Chebyshev polynomials at x in [-1, 1] (Clenshaw).
template <std::size_t n>
double chebyshev_sum(const std::array<double, n>& coefficients, double x) {
  double b1 = 0, b2 = 0;
  for (std::size_t k = n - 1; k > 0; --k) b2 = std::exchange(b1, coefficients[k] + 2 * x * b1 - b2);
  return coefficients[0] + x * b1 - b2;
}

}  // namespace

SpeedIntegral::SpeedIntegral(Expression speed, double duration) : speed_(std::move(speed)), duration_(duration) {
  const auto border = [&](int i) { return duration_ * i / kPanels; };
  for (int i = 0; i < kPanels; ++i)
    for (const double x : chebyshev_coefficients(border(i), border(i + 1)))
      if (std::isfinite(x)) largest_ = std::max(largest_, std::abs(x));
  for (int i = 0; i < kPanels; ++i) append_panels(border(i), border(i + 1), panels_);
}

double SpeedIntegral::Panel::integral_to(double t) const { return before + chebyshev_sum(coefficients, 2 * (t - begin) / (end - begin) - 1); }

double SpeedIntegral::integral_to(double t) const {
  if (t > panels_.back().end) {
    std::vector<Panel> beyond{panels_.back()};
    append_panels(panels_.back().end, t, beyond);
    return beyond.back().integral_to(t);
  }
  const auto after = std::upper_bound(panels_.begin(), panels_.end(), t, [](double time, const Panel& panel) { return time < panel.begin; });
  return (after == panels_.begin() ? *after : *(after - 1)).integral_to(t);
}

// Chebyshev coefficients of the speed, from its values at the extrema of the last polynomial.
SpeedIntegral::Coefficients SpeedIntegral::chebyshev_coefficients(double begin, double end) const {
  constexpr int n = kPolynomialDegree;
  Coefficients value, out;
  for (int i = 0; i <= n; ++i) {
    const std::array<double, 1> t{begin + 0.5 * (end - begin) * (1 + std::cos(kPi * i / n))};
    value[static_cast<std::size_t>(i)] = speed_.value(std::span(t).first(speed_.variables().size()));
  }
  for (int k = 0; k <= n; ++k) {
    double sum = 0.5 * (value.front() + (k % 2 == 0 ? 1 : -1) * value.back());
    for (int i = 1; i < n; ++i) sum += value[static_cast<std::size_t>(i)] * std::cos(kPi * i * k / n);
    out[static_cast<std::size_t>(k)] = (k == 0 || k == n ? 1.0 : 2.0) / n * sum;
  }
  return out;
}

// Halves a panel that a polynomial does not resolve (a curve, a kink or jump, the rounding of a sine of large arguments) until the error is negligible.
void SpeedIntegral::append_panels(double begin, double end, std::vector<Panel>& panels) const {
  const Coefficients c = chebyshev_coefficients(begin, end);
  const double rest = std::max({std::abs(c[kPolynomialDegree]), std::abs(c[kPolynomialDegree - 1]), std::abs(c[kPolynomialDegree - 2])});
  const double size = std::accumulate(c.begin(), c.end(), largest_, [](double sum, double x) { return sum + std::abs(x); });
  const bool resolved = !(rest * (end - begin) > kRounding * size * duration_);  // true also where the speed is not a number
  const double middle = 0.5 * (begin + end);
  if (resolved || panels.size() > kMost || !(begin < middle && middle < end)) {
    panels.push_back(integrate_panel(begin, end, panels.empty() ? 0 : panels.back().integral_to(begin), c));
    return;
  }
  append_panels(begin, middle, panels);
  append_panels(middle, end, panels);
}

// The integral of T_k is T_{k+1} / (2 (k + 1)) - T_{k-1} / (2 (k - 1)), and T_1 for k = 0, T_2 / 4 for k = 1.
SpeedIntegral::Panel SpeedIntegral::integrate_panel(double begin, double end, double before, const Coefficients& of_speed) {
  Panel panel{begin, end, before, {}};
  const double half = 0.5 * (end - begin);
  const auto speed = [&of_speed](std::size_t k) { return k < of_speed.size() ? of_speed[k] : 0; };
  for (std::size_t k = 1; k < panel.coefficients.size(); ++k)
    panel.coefficients[k] = half * ((k == 1 ? 2 : 1) * speed(k - 1) - speed(k + 1)) / (2 * static_cast<double>(k));
  panel.coefficients[0] = -chebyshev_sum(panel.coefficients, -1);
  return panel;
}

}  // namespace pintle
