#include "run/record/sampled_curve.h"

#include <algorithm>
#include <numbers>
#include <tuple>
#include <utility>

#include "integrators/thresholds.h"
#include "linalg/chebyshev_nodes.h"

namespace pintle {
namespace {

constexpr double kNear = 0.98;   // fraction of the square of the peak so far: a step whose grid, and the parabola through its largest points, stay below it is not searched;
                                 // with half of it, a run of 120 joints takes 1.02 times the instructions; with twice as much, peaks are missed
constexpr int kRefinements = 3;  // of a peak between the points of the grid; each interval is a quarter of the previous one
constexpr double kFiner = 0.25;  // ratio of the interval of a refinement to the previous one

// Weights of Romberg's rule on equal intervals, at the points of the grid. theory/time Eq. (5.3)
constexpr CurveGrid::AtPoints romberg_weights(int intervals) {
  std::array<CurveGrid::AtPoints, 5> rule{};  // the trapezoidal rule on 1, 2, 4, ... intervals, then extrapolated
  std::size_t levels = 0;
  for (int n = 1; n <= intervals; n *= 2, ++levels)
    for (int p = 0; p <= n; ++p) rule[levels][static_cast<std::size_t>(p * CurveGrid::kIntervals / n)] = (p == 0 || p == n ? 0.5 : 1.0) / n;
  double power = 4;
  for (std::size_t k = 1; k < levels; ++k, power *= 4)
    for (std::size_t j = levels - 1; j >= k; --j)
      for (std::size_t p = 0; p < rule[j].size(); ++p) rule[j][p] += (rule[j][p] - rule[j - 1][p]) / (power - 1);
  return rule[levels - 1];
}
constexpr CurveGrid::AtPoints kAll = romberg_weights(CurveGrid::kIntervals), kHalf = romberg_weights(CurveGrid::kIntervals / 2), kQuarter = romberg_weights(CurveGrid::kIntervals / 4);

double sum_of(const CurveGrid::AtPoints& weight, const CurveGrid::AtPoints& value) {
  double sum = 0;
  for (std::size_t p = 0; p < value.size(); ++p) sum += weight[p] * value[p];
  return sum;
}

// Down to intervals as short as the rounding of their ends.
double adaptive_romberg(const std::function<double(double)>& at, double from, double to, double allowed) {
  CurveGrid::AtPoints value;
  for (std::size_t p = 0; p < value.size(); ++p) value[p] = at(from + (to - from) * static_cast<double>(p) / CurveGrid::kIntervals);
  const double whole = (to - from) * sum_of(kAll, value), middle = 0.5 * (from + to);
  if (to - from < kLastBits || !(std::abs(whole - (to - from) * sum_of(kHalf, value)) > allowed)) return whole;
  return adaptive_romberg(at, from, middle, allowed) + adaptive_romberg(at, middle, to, allowed);
}

// Through three equidistant squares; x is measured from the middle one in units of their distance. theory/time Eq. (5.4)
struct Parabola {
  double before, here, after;

  double bend() const { return before - 2 * here + after; }
  double value(double x) const { return here + 0.5 * x * (after - before + x * bend()); }
  /// Where it has its maximum; the larger end if it has none.
  double top() const { return bend() < 0 ? std::clamp(0.5 * (before - after) / bend(), -1.0, 1.0) : before > after ? -1 : after > before ? 1 : 0; }
};

}  // namespace

CurveGrid::CurveGrid(int n, double accuracy) : n_(n), accuracy_(std::max(accuracy, kFinest)) {
  for (int i = 0; i < n; ++i) {
    x_[static_cast<std::size_t>(i)] = 0.5 * (1 - std::cos(std::numbers::pi * i / (n - 1)));
    barycentric_[static_cast<std::size_t>(i)] = (i % 2 == 0 ? 1 : -1) * (i == 0 || i == n - 1 ? 0.5 : 1);
  }
  for (std::size_t p = 0; p < at_point_.size(); ++p) {
    at_point_[p] = weights(static_cast<double>(p) / kIntervals);
    for (std::size_t i = 0; i < of_sample_.size(); ++i) of_sample_[i][p] = at_point_[p][i];
  }
  integral_ = integral(0, 1);
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(n); ++i) after_[i] = integral(x_[i], x_[i + 1]);
  for (std::size_t below = 0; below < last_coefficients_.size(); ++below) {
    const int degree = n - 1 - static_cast<int>(below);
    for (int i = 0; i < n; ++i) last_coefficients_[below][static_cast<std::size_t>(i)] = (degree == n - 1 ? 1.0 : 2.0) / (n - 1) * chebyshev_weight(n, degree, i);
  }
}

// Gauss's rule with four points is exact for polynomials of degree 7.
CurveGrid::Weights CurveGrid::integral(double from, double to) const {
  constexpr std::array<double, 2> kGauss{0.33998104358485626, 0.86113631159405258}, kWeight{0.65214515486254614, 0.34785484513745386};
  Weights out{};
  for (std::size_t g = 0; g < kGauss.size(); ++g)
    for (const double side : {-1.0, 1.0}) {
      const Weights w = weights(from + 0.5 * (to - from) * (1 + side * kGauss[g]));
      for (std::size_t i = 0; i < w.size(); ++i) out[i] += 0.5 * (to - from) * kWeight[g] * w[i];
    }
  return out;
}

double CurveGrid::chebyshev_tail(const double* samples, int stride) const {
  double sum = 0;
  for (const Weights& weight : last_coefficients_) {
    double coefficient = 0;
    for (int i = 0; i < n_; ++i) coefficient += weight[static_cast<std::size_t>(i)] * samples[i * stride];
    sum += std::abs(coefficient);
  }
  return sum;
}

CurveGrid::Weights CurveGrid::weights(double x) const {
  Weights out{};
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
    if (x == x_[i]) {
      out.fill(0);
      out[i] = 1;
      return out;
    }
    sum += out[i] = barycentric_[i] / (x - x_[i]);
  }
  for (double& w : out) w /= sum;
  return out;
}

double weighted_sum(const CurveGrid& grid, const CurveGrid::Weights& weight, const double* samples, int stride) {
  double value = 0;
  for (int i = 0; i < grid.n(); ++i) value += weight[static_cast<std::size_t>(i)] * samples[i * stride];
  return value;
}

double zero_between(const CurveGrid& grid, const double* samples, int stride, double a, double f_a, double b, double f_b) {
  constexpr int kIterations = 6;  // with 4, turning points are wrong by 1e-5 of a step
  for (int i = 0; i < kIterations; ++i) {
    const double x = (a * f_b - b * f_a) / (f_b - f_a), f = value_at(grid, samples, stride, x);
    if (f == 0) return x;
    if ((f < 0) == (f_b < 0)) f_a *= 0.5;
    else std::tie(a, f_a) = std::pair{b, f_b};
    std::tie(b, f_b) = std::pair{x, f};
  }
  return b;
}

double weighted_square(const CurveGrid& grid, const CurveGrid::Weights& weight, const double* samples, int stride, int n) {
  double square = 0;
  for (int c = 0; c < n; ++c) {
    const double component = weighted_sum(grid, weight, samples + c, stride);
    square += component * component;
  }
  return square;
}

RombergOnGrid::RombergOnGrid(const CurveGrid::AtPoints& value, double total, double accuracy, bool every_second)
    : integral(sum_of(every_second ? kHalf : kAll, value)), allowed(accuracy * std::max(std::abs(integral), total)),
      agrees(!(std::abs(integral - sum_of(every_second ? kQuarter : kHalf, value)) > allowed)) {}

double adaptive_romberg_integral(const std::function<double(double)>& at, double allowed) {
  return adaptive_romberg(at, 0, 0.5, allowed) + adaptive_romberg(at, 0.5, 1, allowed);
}

double largest_on_grid(const CurveGrid::AtPoints& value) {
  const auto largest = static_cast<std::size_t>(std::max_element(value.begin(), value.end()) - value.begin());
  const std::size_t middle = std::clamp<std::size_t>(largest, 1, CurveGrid::kIntervals - 1);
  const Parabola parabola{value[middle - 1], value[middle], value[middle + 1]};
  return std::max(value[largest], parabola.value(parabola.top()));
}

template <int n, Sums kind>
CurveGrid::AtPoints add_curve(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums) {
  static_assert(n == 1 || kind == Sums::kOfSize);
  CurveGrid::AtPoints square{}, component;
  for (int c = 0; c < n; ++c) {
    along_grid(grid, samples + c, stride, component);
    for (std::size_t p = 0; p < square.size(); ++p) square[p] += component[p] * component[p];
  }
  const auto at = [&](double x) { return weighted_square(grid, grid.weights(x), samples, stride, n); };
  if constexpr (kind == Sums::kWithSign) {
    sums.integral += h * sum_of(kAll, component);
  } else if constexpr (n == 1) {
    for_each_sign(grid, samples, stride, component, [&](double from, double to) {
      const bool whole = from == 0 && to == 1;
      sums.integral += h * std::abs(whole ? sum_of(kAll, component) : weighted_sum(grid, grid.integral(from, to), samples, stride));
    });
  } else {
    CurveGrid::AtPoints size;
    for (std::size_t p = 0; p < size.size(); ++p) size[p] = std::sqrt(square[p]);
    sums.integral += h * integral_over_step(size, sums.integral / h, grid.accuracy(), [&](double x) { return std::sqrt(at(x)); });
  }
  sums.square += h * sum_of(kAll, square);
  const double beaten = sums.peak * sums.peak;
  const auto largest = static_cast<std::size_t>(std::max_element(square.begin(), square.end()) - square.begin());
  const std::size_t middle = std::clamp<std::size_t>(largest, 1, CurveGrid::kIntervals - 1);
  Parabola parabola{square[middle - 1], square[middle], square[middle + 1]};
  double best = square[largest];
  if (!(std::max(best, parabola.value(parabola.top())) > kNear * beaten)) return square;
  double d = 1.0 / CurveGrid::kIntervals, from = static_cast<double>(middle) * d, x = static_cast<double>(largest) * d;
  for (int pass = 0; pass < kRefinements; ++pass) {
    if (pass > 0) {
      d *= kFiner;
      from = std::clamp(x, d, 1 - d);
      parabola = {at(from - d), at(from), at(from + d)};
    }
    const double top = from + parabola.top() * d, there = at(top);
    if (there > best) {
      best = there;
      x = top;
    }
  }
  if (!(best > beaten)) return square;
  sums.peak = kind == Sums::kWithSign && value_at(grid, samples, stride, x) < 0 ? -std::sqrt(best) : std::sqrt(best);
  sums.peak_time = t0 + x * h;
  return square;
}

template CurveGrid::AtPoints add_curve<1, Sums::kWithSign>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<1>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<2>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<3>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);

}  // namespace pintle
