#include "check/check_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pintle {
namespace {

double largest(const Eigen::VectorXd& x) {
  return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0;
}

double relative(double error, double scale) {
  if (error == 0) return 0;
  return error / scale;  // infinite or NaN: counted as such
}

struct Difference {
  Eigen::VectorXd central;  // fourth order
  double bend = 0;          // of the one-sided slopes, second order
};

Difference difference(const Comparisons::Curve& curve, double h) {
  const Eigen::VectorXd back2 = curve(-2 * h), back = curve(-h), here = curve(0), ahead = curve(h),
                        ahead2 = curve(2 * h);
  const Eigen::VectorXd forward = (-3 * here + 4 * ahead - ahead2) / (2 * h);
  const Eigen::VectorXd backward = (3 * here - 4 * back + back2) / (2 * h);
  return {(8 * (ahead - back) - (ahead2 - back2)) / (12 * h), largest(forward - backward)};
}

}  // namespace

void Comparisons::slope(const Eigen::VectorXd& slope, const Curve& curve, double step, double scale,
                        const CheckPlace& place) {
  constexpr int kShrinks = 4;     // each to a tenth
  constexpr double kKink = 1e-2;  // one-sided slopes that differ so much at the shortest step, of the scale
  constexpr double kSteady = 0.1; // a kink bends the slope by as much at every step: a smooth curve by less at shorter ones, rounding by more
  constexpr double kFalls = 0.4;  // of the error at steps ten times as long: 0.1 where the slope is right and jumps itself, 0.32 where it begins as a root (Hertz at the touch), 1 where it is wrong
  constexpr double kAlmost = 10;  // times the tolerance; a slope that is wrong by as much is seen all the same, unless rounding hides it at the next shorter steps
  double best = INFINITY, bend = 0, bend_before = 0, error = INFINITY;
  bool falls = false, fell_to_best = false;
  for (int shrink = 0; shrink <= kShrinks; ++shrink, step /= 10) {
    const Difference d = difference(curve, step);
    const double size = std::max({scale, largest(slope), largest(d.central)});
    const double error_before = error;
    error = largest(slope - d.central);
    falls = shrink > 0 && error < kFalls * error_before;  // at the shortest steps: long ones meet other kinks
    const double mismatch = relative(error, size);
    if (mismatch < 0.5 * best) fell_to_best = falls;
    best = std::isnan(mismatch) ? mismatch : std::min(best, mismatch);
    if (best <= item_.tolerance || std::isnan(best)) return count(best, place);
    bend_before = bend;
    bend = d.bend / size;
  }
  // What falls to the rounding of the curve, and almost to what is allowed, would have fallen further.
  if (falls || (fell_to_best && best < kAlmost * item_.tolerance) || bend > kKink || (std::abs(bend - bend_before) < kSteady * bend && best <= bend)) {
    ++item_.at_kinks;
    return;
  }
  count(best, place);
}

void Comparisons::vanishes(double error, double scale, const CheckPlace& place) {
  count(relative(std::abs(error), scale), place);
}

void Comparisons::count(double mismatch, const CheckPlace& place) {
  ++item_.comparisons;
  if (std::isnan(item_.worst) || mismatch < item_.worst || (mismatch == 0 && !item_.place.empty())) return;
  if (mismatch == item_.worst && !item_.place.empty()) return;
  item_.worst = mismatch;
  item_.place =
      fmt::format("{}{}{}, {}", place.kind, place.name.empty() ? "" : " ", place.name,
                  place.state == 0 ? std::string("as assembled") : fmt::format("perturbed state {}", place.state));
}

}  // namespace pintle
