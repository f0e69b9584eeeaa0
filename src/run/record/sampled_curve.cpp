#include "run/record/sampled_curve.h"

#include <algorithm>
#include <numbers>

#include "linalg/chebyshev_nodes.h"

namespace pintle {
namespace {

constexpr double kNear = 0.98;   // fraction of the square of the peak so far: a step whose grid, and the parabola through its largest points, stay below it is not searched;
                                 // with half of it, a run of 120 joints takes 1.02 times the instructions; with twice as much, peaks are missed
constexpr int kRefinements = 3;  // of a peak between the points of the grid; each interval is a quarter of the previous one
constexpr double kFiner = 0.25;  // ratio of the interval of a refinement to the previous one

template <int n>
double square_at(const CurveGrid& grid, double x, const double* samples, int stride, std::array<double, n>& value) {
  const CurveGrid::Weights weight = grid.weights(x);
  value.fill(0);
  for (int i = 0; i < grid.n(); ++i)
    for (int c = 0; c < n; ++c) value[static_cast<std::size_t>(c)] += weight[static_cast<std::size_t>(i)] * samples[i * stride + c];
  double square = 0;
  for (const double component : value) square += component * component;
  return square;
}

// Simpson's rule. theory/time Eq. (5.3)
constexpr CurveGrid::AtPoints kSimpson = [] {
  constexpr double third = 1.0 / (3 * CurveGrid::kIntervals);
  CurveGrid::AtPoints weight{};
  for (std::size_t p = 0; p < weight.size(); ++p) weight[p] = p == 0 || p + 1 == weight.size() ? third : p % 2 == 1 ? 4 * third : 2 * third;
  return weight;
}();

// Through three equidistant squares; x is measured from the middle one in units of their distance. theory/time Eq. (5.4)
struct Parabola {
  double before, here, after;

  double bend() const { return before - 2 * here + after; }
  double value(double x) const { return here + 0.5 * x * (after - before + x * bend()); }
  /// Where it has its maximum; the larger end if it has none.
  double top() const { return bend() < 0 ? std::clamp(0.5 * (before - after) / bend(), -1.0, 1.0) : before > after ? -1 : after > before ? 1 : 0; }
};

}  // namespace

CurveGrid::CurveGrid(int n) : n_(n) {
  for (int i = 0; i < n; ++i) {
    x_[static_cast<std::size_t>(i)] = 0.5 * (1 - std::cos(std::numbers::pi * i / (n - 1)));
    barycentric_[static_cast<std::size_t>(i)] = (i % 2 == 0 ? 1 : -1) * (i == 0 || i == n - 1 ? 0.5 : 1);
  }
  for (std::size_t p = 0; p < at_point_.size(); ++p) {
    at_point_[p] = weights(static_cast<double>(p) / kIntervals);
    for (std::size_t i = 0; i < of_sample_.size(); ++i) of_sample_[i][p] = at_point_[p][i];
  }
  // Gauss's rule with four points is exact for polynomials of degree 7.
  constexpr std::array<double, 2> kGauss{0.33998104358485626, 0.86113631159405258}, kWeight{0.65214515486254614, 0.34785484513745386};
  const auto add_integral = [&](double from, double to, Weights& integral) {
    for (std::size_t g = 0; g < kGauss.size(); ++g)
      for (const double side : {-1.0, 1.0}) {
        const Weights w = weights(from + 0.5 * (to - from) * (1 + side * kGauss[g]));
        for (std::size_t i = 0; i < w.size(); ++i) integral[i] += 0.5 * (to - from) * kWeight[g] * w[i];
      }
  };
  add_integral(0, 1, integral_);
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(n); ++i) add_integral(x_[i], x_[i + 1], after_[i]);
  for (std::size_t below = 0; below < last_coefficients_.size(); ++below) {
    const int degree = n - 1 - static_cast<int>(below);
    for (int i = 0; i < n; ++i) last_coefficients_[below][static_cast<std::size_t>(i)] = (degree == n - 1 ? 1.0 : 2.0) / (n - 1) * chebyshev_weight(n, degree, i);
  }
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
  double integral = 0, of_square = 0;
  for (std::size_t p = 0; p < square.size(); ++p) {
    const double weight = kSimpson[p];
    integral += weight * (kind == Sums::kWithSign ? component[p] : std::sqrt(square[p]));
    of_square += weight * square[p];
  }
  sums.integral += h * integral;
  sums.square += h * of_square;
  const double beaten = sums.peak * sums.peak;
  const auto largest = static_cast<std::size_t>(std::max_element(square.begin(), square.end()) - square.begin());
  const std::size_t middle = std::clamp<std::size_t>(largest, 1, CurveGrid::kIntervals - 1);
  Parabola parabola{square[middle - 1], square[middle], square[middle + 1]};
  double best = square[largest];
  if (!(std::max(best, parabola.value(parabola.top())) > kNear * beaten)) return square;
  double d = 1.0 / CurveGrid::kIntervals, from = static_cast<double>(middle) * d, x = static_cast<double>(largest) * d;
  std::array<double, n> value;
  const auto at = [&](double share) { return square_at<n>(grid, share, samples, stride, value); };
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
  at(x);
  sums.peak = kind == Sums::kWithSign ? value[0] : std::sqrt(best);
  sums.peak_time = t0 + x * h;
  return square;
}

template CurveGrid::AtPoints add_curve<1, Sums::kWithSign>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<1>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<2>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);
template CurveGrid::AtPoints add_curve<3>(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);

}  // namespace pintle
