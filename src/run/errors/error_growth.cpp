#include "run/errors/error_growth.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pintle {
namespace {

constexpr double kLatePart = 0.25; // last part of a run: passes that agree there have not separated as chaotic motions do. With half of it nothing changes; with 0.5 a striking train that comes to rest is taken for chaotic
constexpr double kOfLargest = 0.1;                 // saturation as a fraction of the largest difference, where that one shows how large they can become. Halved or doubled, tests/models/two_bouncing_pins.toml misses its tolerance at 1e-3 without a horizon
constexpr double kFitted = 1e-6;                   // smallest difference that is fitted, as a fraction of saturation
constexpr int kMostBlocks = 32, kLeastBlocks = 8;  // blocks of rows, whose largest differences are fitted; with fewer nothing is fitted
constexpr double kLeastGain = 4.6;                 // least rise of the logarithm over the fit: a factor of a hundred
constexpr double kLeastBend = -0.28;               // ratio of the second to the first Legendre coefficient: 0 for an exponential, -0.56 for any power of time
constexpr double kSure = 5;                        // standard errors by which a rate must be above zero
constexpr double kSureOfPlaces = 3;                // the same for positions, whose errors grow in stairs where pins graze their bush. Doubled, that model has a horizon at no tolerance; halved, nothing changes
constexpr double kSurePair = 3;                    // standard errors by which two rates may differ
constexpr double kSameRate = 0.3;                  // additional difference allowed, as a fraction of the rate

struct Blocks {
  int n = 0;
  std::array<double, kMostBlocks> t{}, y{};
};

// Logarithms of the largest difference in equal parts of the time; parts without a difference are left out.
Blocks blocks_of(const DifferenceCurve& curve, std::size_t first, std::size_t last) {
  Blocks b;
  const std::size_t rows = last - first;
  const std::size_t parts = std::min<std::size_t>(kMostBlocks, rows / 2);
  for (std::size_t p = 0; p < parts; ++p) {
    const std::size_t from = first + p * rows / parts, to = first + (p + 1) * rows / parts;
    double e = 0;
    for (std::size_t i = from; i < to; ++i) e = std::max(e, curve.e[i]);
    if (!(e > 0)) continue;
    b.t[b.n] = 0.5 * (curve.t[from] + curve.t[to - 1]);
    b.y[b.n++] = std::log(e);
  }
  return b;
}

struct Line {
  double mean_x = 0, mean_y = 0, slope = 0, error = 0, squares = 0;  // squares of the residuals
};

// Least squares. Neighbouring residuals are correlated, which increases the standard error. Eq. (6.6).
Line fit_line(int n, const std::array<double, kMostBlocks>& x, const std::array<double, kMostBlocks>& y) {
  Line line;
  for (int i = 0; i < n; ++i) {
    line.mean_x += x[i] / n;
    line.mean_y += y[i] / n;
  }
  double xx = 0, xy = 0;
  for (int i = 0; i < n; ++i) {
    xx += (x[i] - line.mean_x) * (x[i] - line.mean_x);
    xy += (x[i] - line.mean_x) * (y[i] - line.mean_y);
  }
  if (!(xx > 0)) return line;
  line.slope = xy / xx;
  double last = 0, neighbours = 0;
  for (int i = 0; i < n; ++i) {
    const double residual = y[i] - line.mean_y - line.slope * (x[i] - line.mean_x);
    line.squares += residual * residual;
    if (i > 0) neighbours += residual * last;
    last = residual;
  }
  const double alike = line.squares > 0 ? std::clamp(neighbours / line.squares, 0.0, 0.9) : 0;
  line.error = std::sqrt(line.squares / (n - 2) / xx * (1 + alike) / (1 - alike));
  return line;
}

// By how much the rate over another interval of the same length would differ, where growth comes in steps of any size. Everything after a step is higher
// by it, which the residuals about a line hardly show. This is the variance of a sum of such steps, with the neighbour weights of Newey and West. Eq. (6.8a).
double scatter_of_steps(const Blocks& b) {
  constexpr int kNeighbours = 3;  // on either side, whose increments count as correlated: with none, noise about a line would make half the rate
  const int n = b.n - 1;
  const double mean = (b.y[n] - b.y[0]) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - kNeighbours); j <= std::min(n - 1, i + kNeighbours); ++j)
      sum += (1 - std::abs(i - j) / (kNeighbours + 1.0)) * (b.y[i + 1] - b.y[i] - mean) * (b.y[j + 1] - b.y[j] - mean);
  return std::sqrt(std::max(0.0, sum) * n / (n - 1)) / (b.t[n] - b.t[0]);
}

// Ratio of the second to the first coefficient of a Legendre series over the fitted part. Eq. (6.7).
double bend(const Blocks& b) {
  const double middle = 0.5 * (b.t[0] + b.t[b.n - 1]), half = 0.5 * (b.t[b.n - 1] - b.t[0]);
  // Gram-Schmidt orthogonalization of 1, s, P2(s) on the blocks.
  double s_mean = 0, p_mean = 0;
  for (int i = 0; i < b.n; ++i) {
    const double s = (b.t[i] - middle) / half;
    s_mean += s / b.n;
    p_mean += (1.5 * s * s - 0.5) / b.n;
  }
  double ss = 0, sp = 0, sy = 0;
  for (int i = 0; i < b.n; ++i) {
    const double s = (b.t[i] - middle) / half, p = 1.5 * s * s - 0.5;
    ss += (s - s_mean) * (s - s_mean);
    sp += (s - s_mean) * (p - p_mean);
    sy += (s - s_mean) * b.y[i];
  }
  double pp = 0, py = 0;
  for (int i = 0; i < b.n; ++i) {
    const double s = (b.t[i] - middle) / half, p = 1.5 * s * s - 0.5 - p_mean - sp / ss * (s - s_mean);
    pp += p * p;
    py += p * b.y[i];
  }
  const double second = py / pp, first = (sy - sp * second) / ss;
  return second / first;
}

// Passes that have separated for good do not return to within the tolerance by the end of the run. Those of a striking train that comes to rest do.
bool comes_together_again(const DifferenceCurve& forces, double apart) {
  const double from = forces.t.empty() ? 0 : forces.t.back() - kLatePart * (forces.t.back() - forces.t.front());
  for (std::size_t i = 0; i < forces.t.size(); ++i)
    if (forces.t[i] >= from && forces.e[i] > apart) return false;
  return true;
}

}  // namespace

double ErrorGrowth::extrapolated(double t, double with_rate) const {
  constexpr double kMost = 600;  // upper limit on the exponent: keeps the number finite
  return level * std::exp(std::min(kMost, with_rate * (t - until)));
}

namespace {

// Fits up to differences of `most`; the rate must be above zero by `sure` standard errors.
ErrorGrowth fit_growth_to(double most, double sure, const DifferenceCurve& curve) {
  ErrorGrowth growth;
  std::size_t last = 0, first = 0;
  while (last < curve.e.size() && curve.e[last] < most) ++last;
  growth.saturated = last < curve.e.size();
  for (std::size_t i = 0; i < last; ++i)
    if (curve.e[i] <= kFitted * most) first = i + 1;
  if (first >= last) return growth;
  const Blocks b = blocks_of(curve, first, last);
  if (b.n < kLeastBlocks) return growth;
  const Line line = fit_line(b.n, b.t, b.y);
  std::array<double, kMostBlocks> log_t{};
  for (int i = 0; i < b.n; ++i) log_t[i] = std::log(std::max(b.t[i], 1e-300));
  const Line power = fit_line(b.n, log_t, b.y);
  growth.rate = line.slope;
  growth.rate_error = line.error;
  growth.rate_scatter = scatter_of_steps(b);
  growth.until = b.t[b.n - 1];
  growth.level = std::exp(line.mean_y + line.slope * (growth.until - line.mean_x));
  const double gain = line.slope * (b.t[b.n - 1] - b.t[0]);
  growth.exponential = gain > kLeastGain && line.slope > sure * line.error && line.squares < power.squares && bend(b) > kLeastBend;
  return growth;
}

}  // namespace

ErrorGrowth fit_growth(const DifferenceCurve& curve) { return fit_growth_to(kSaturated, kSure, curve); }

ErrorGrowth fit_growth_to_largest(const DifferenceCurve& curve) {
  ErrorGrowth growth = fit_growth_to(kOfLargest * largest_of(curve.e), kSureOfPlaces, curve);
  growth.to_largest = true;
  // Every curve has a largest value. The curve is saturated if continued growth would have passed that value by far.
  growth.saturated = growth.saturated && growth.rate * (curve.t.back() - growth.until) > 2 * std::log(1 / kOfLargest);
  return growth;
}

bool same_growth(const ErrorGrowth& first, const ErrorGrowth& second) {
  // Positions and forces reach saturation at different times: these cannot be compared.
  const bool later = second.until > first.until || first.to_largest != second.to_largest;
  return first.exponential && second.exponential && later &&
         std::abs(first.rate - second.rate) < kSurePair * std::hypot(first.rate_error, second.rate_error) + kSameRate * std::min(first.rate, second.rate);
}

template <class S>
ErrorGrowth growth_between(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, bool of_motion, double tolerance, double promised) {
  if (of_motion) return fit_growth(motion_difference_curve(system, coarse, fine));
  const DifferenceCurve forces = force_difference_curve(system, coarse, fine);
  if (comes_together_again(forces, promised * tolerance)) return {};
  const ErrorGrowth of_forces = fit_growth(forces);
  if (of_forces.exponential || !of_forces.saturated) return of_forces;
  ErrorGrowth of_places = fit_growth_to_largest(motion_difference_curve(system, coarse, fine));
  if (!of_places.exponential || !of_places.saturated) return of_forces;
  of_places.level = tolerance * std::exp(of_places.rate * (of_places.until - curve_horizon(forces, tolerance)));
  return of_places;
}

template ErrorGrowth growth_between(const System& system, const BasicForceTable<Planar>& coarse, const BasicForceTable<Planar>& fine, bool of_motion, double tolerance, double promised);
PINTLE_IN_SPACE(template ErrorGrowth growth_between(const BasicSystem<Spatial>& system, const BasicForceTable<Spatial>& coarse, const BasicForceTable<Spatial>& fine, bool of_motion, double tolerance, double promised);)

}  // namespace pintle
