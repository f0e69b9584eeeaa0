#include "joints/belt.h"

#include <cmath>
#include <numbers>

namespace pintle {
namespace {

// The angles of discs and of the way between them are known up to full turns. A belt gives way little and may be slack by much.
constexpr double kMostStretch = 0.1;  // of what a whole turn winds

GapFunction gap_at(const Planar::Vec& z, const double* parameters) { return Belt{parameters[0], parameters[1], parameters[2]}(z); }

}  // namespace

double Belt::run(const Planar::Vec& z) const {
  const double distance = std::hypot(z[0], z[1]), apart = std::abs(w());
  return distance > apart ? std::sqrt((distance - apart) * (distance + apart)) : 0;
}

GapFunction Belt::operator()(const Planar::Vec& z) const {
  GapFunction g;
  const double apart = std::abs(w()), t = run(z);
  const double a = std::atan2(z[1], z[0]) + (t > 0 || apart > 0 ? std::atan2(w(), t) : 0), c = std::cos(a), s = std::sin(a);  // (2.15)
  g.gap = t + w() * a - radius_second * z[2] - length;                                                                      // (2.16)
  if (const double turn = 2 * std::numbers::pi * apart; turn > 0) g.gap -= turn * std::ceil(g.gap / turn - kMostStretch);
  g.gradient << c, s, -radius_second;
  if (!(t > 0)) return g;
  g.hessian(0, 0) = s * s / t;
  g.hessian(1, 1) = c * c / t;
  g.hessian(0, 1) = g.hessian(1, 0) = -s * c / t;
  return g;
}

FunctionGap function_of(const Belt& belt) { return {gap_at, {belt.radius_first, belt.radius_second, belt.length}}; }

std::optional<Belt> belt_of(const JointDisplacement& displacement) {
  const auto* function = std::get_if<FunctionGap>(&displacement);
  if (!function || function->at != gap_at) return {};
  return Belt{function->parameters[0], function->parameters[1], function->parameters[2]};
}

}  // namespace pintle
