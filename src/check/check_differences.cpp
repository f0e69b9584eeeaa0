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
  Eigen::VectorXd central;  // of fourth order
  double bend = 0;          // difference of the one-sided slopes, of second order
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
  constexpr double kKink = 1e-2;  // as a fraction of the scale: one-sided slopes that differ by more at the shortest step mean a kink
  constexpr double kSteady = 0.1; // relative change of the one-sided slopes' difference that still counts as constant: at a kink it is the same at every step, on a smooth curve smaller at shorter ones, from roundoff larger
  constexpr double kFalls = 0.4;  // the error falls if it is below this fraction of that at steps ten times as long: 0.1 if the slope is right and has a kink itself, 0.32 if it begins as a root (Hertz at the touch), 1 if it is wrong
  constexpr double kAlmost = 10;  // as a multiple of the tolerance: upper limit on a fallen error that may end in roundoff. A slope that is wrong by as much is still detected, unless roundoff hides it at the next shorter steps
  double best = INFINITY, bend = 0, bend_before = 0, error = INFINITY;
  bool falls = false, fell_to_best = false;
  for (int shrink = 0; shrink <= kShrinks; ++shrink, step /= 10) {
    const Difference d = difference(curve, step);
    const double size = std::max({scale, largest(slope), largest(d.central)});
    const double error_before = error;
    error = largest(slope - d.central);
    falls = shrink > 0 && error < kFalls * error_before;  // at the shortest steps: long ones reach other kinks
    const double mismatch = relative(error, size);
    if (mismatch < 0.5 * best) fell_to_best = falls;
    best = std::isnan(mismatch) ? mismatch : std::min(best, mismatch);
    if (best <= item_.tolerance || std::isnan(best)) return count(best, place);
    bend_before = bend;
    bend = d.bend / size;
  }
  // An error that falls to the roundoff of the curve, and almost to the tolerance, would have fallen
  // further.
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
