// Curves of the loads inside a step: polynomials through samples, evaluated on a uniform grid, from which integrals and peaks are taken.
// theory/time section 5.1.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

namespace pintle {

/// Peak and integrals of a curve over one step or several. The integrals are not divided by the time yet.
struct CurveSums {
  double peak = 0, peak_time = 0;         // largest magnitude, with its sign for a scalar; [s]
  double integral = 0, square = 0;        // over time: of the magnitude, with its sign for a scalar; of its square
};

/// The instants of a step at which curves are sampled, at most kMost, and the uniform grid on which they are evaluated, as fractions of the step.
class CurveGrid {
 public:
  static constexpr int kMost = 7, kIntervals = 16, kPoints = kIntervals + 1;
  using Weights = std::array<double, kMost>;        // of the samples; those that do not exist have 0
  using AtPoints = std::array<double, kPoints>;

  static constexpr double kFinest = 1e-9;  // least `accuracy`, far above the rounding of the sums, below which no halving would make two rules agree. With half or twice as much, means change by 4e-9 at most
  /// n samples, from 2 to kMost, at the extrema of the Chebyshev polynomial of degree n - 1; polynomials of that degree are reproduced exactly.
  /// `accuracy`: of integrals of magnitudes, as a fraction of them.
  explicit CurveGrid(int n, double accuracy = kFinest);

  int n() const { return n_; }
  double accuracy() const { return accuracy_; }
  double instant(int sample) const { return x_[static_cast<std::size_t>(sample)]; }
  const Weights& at_point(int point) const { return at_point_[static_cast<std::size_t>(point)]; }
  /// Weights of one sample at all points.
  const AtPoints& of_sample(int sample) const { return of_sample_[static_cast<std::size_t>(sample)]; }
  /// Weights of the integral of the polynomial over the step, in units of the step.
  const Weights& integral() const { return integral_; }
  /// The same from one fraction of the step to another.
  Weights integral(double from, double to) const;
  /// The same from one sample to the next.
  const Weights& integral_after(int sample) const { return after_[static_cast<std::size_t>(sample)]; }
  /// Sum of the magnitudes of the last two Chebyshev coefficients of the polynomial through `samples[i * stride]`: what more samples might still change.
  double chebyshev_tail(const double* samples, int stride) const;
  /// Weights of the samples at any fraction of the step.
  Weights weights(double x) const;

 private:
  int n_;
  double accuracy_;
  Weights x_{}, barycentric_{}, integral_{};
  std::array<Weights, kMost> after_{};
  std::array<Weights, 2> last_coefficients_{};
  std::array<Weights, kPoints> at_point_{};
  std::array<AtPoints, kMost> of_sample_{};
};

/// The polynomial through `samples[i * stride]` at all points.
inline void along_grid(const CurveGrid& grid, const double* samples, int stride, CurveGrid::AtPoints& value) {
  value.fill(0);
  for (int i = 0; i < grid.n(); ++i) {
    const CurveGrid::AtPoints& weight = grid.of_sample(i);
    const double sample = samples[i * stride];
    for (std::size_t p = 0; p < value.size(); ++p) value[p] += weight[p] * sample;
  }
}
/// The largest of the values, or the maximum of the parabola through it and its neighbours if that is larger.
double largest_on_grid(const CurveGrid::AtPoints& value);

/// The polynomial through `samples[i * stride]` where the samples have these weights.
double weighted_sum(const CurveGrid& grid, const CurveGrid::Weights& weight, const double* samples, int stride);
/// The same at any fraction of the step.
inline double value_at(const CurveGrid& grid, const double* samples, int stride, double x) { return weighted_sum(grid, grid.weights(x), samples, stride); }
/// Where the curve is zero between the fractions x = a and x = b of the step, at which it has the values f_a and f_b of different signs: regula falsi,
/// Illinois variant. An integral up to there is wrong by the square of the distance.
double zero_between(const CurveGrid& grid, const double* samples, int stride, double a, double f_a, double b, double f_b);
/// Calls part(from, to), fractions of the step, for each part of it in which the curve with these values at the points keeps its sign.
template <class Part>
void for_each_sign(const CurveGrid& grid, const double* samples, int stride, const CurveGrid::AtPoints& value, const Part& part) {
  constexpr double kInterval = 1.0 / CurveGrid::kIntervals;
  double from = 0;
  for (std::size_t p = 0; p + 1 < value.size(); ++p) {
    if ((value[p] < 0) == (value[p + 1] < 0)) continue;
    const double to = zero_between(grid, samples, stride, static_cast<double>(p) * kInterval, value[p], static_cast<double>(p + 1) * kInterval, value[p + 1]);
    if (to > from) part(from, to);
    from = to;
  }
  if (from < 1) part(from, 1.0);
}
/// Square of the magnitude of the vector with the components `samples[i * stride + c]`, c < n, where the samples have these weights.
double weighted_square(const CurveGrid& grid, const CurveGrid::Weights& weight, const double* samples, int stride, int n);

/// Integral over a step, in units of the step, by Romberg's rule on every point, or on every second one. theory/time Eq. (5.3)
struct RombergOnGrid {
  double integral;
  double allowed;  // difference from the rule on half of these points that is within `accuracy` of the integral or of `total`, that of the steps so far
  bool agrees;     // the difference is not larger

  RombergOnGrid(const CurveGrid::AtPoints& value, double total, double accuracy, bool every_second);
};
/// The integral of a function of the fraction of the step, halved until the rules agree.
double adaptive_romberg_integral(const std::function<double(double)>& at, double allowed);

/// Integral over the step of the function `at` of the fraction of the step, with these values at the points. The step is divided only near the kinks of a magnitude.
template <class At>
double integral_over_step(const CurveGrid::AtPoints& value, double total, double accuracy, const At& at, bool every_second = false) {
  const RombergOnGrid grid_estimate(value, total, accuracy, every_second);
  return grid_estimate.agrees ? grid_estimate.integral : adaptive_romberg_integral(std::cref(at), grid_estimate.allowed);
}

enum class Sums { kOfSize, kWithSign };
/// Adds a step of h seconds from t0 to `sums`, for the magnitude of a vector of n components with the samples `samples[i * stride + c]`, or for a scalar
/// with its sign. Returns the square of the magnitude at all points.
template <int n, Sums kind = Sums::kOfSize>
CurveGrid::AtPoints add_curve(const CurveGrid& grid, const double* samples, int stride, double t0, double h, CurveSums& sums);

}  // namespace pintle
