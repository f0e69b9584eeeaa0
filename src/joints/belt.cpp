#include "joints/belt.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pintle {
namespace {

GapFunction gap_at(const Planar::Vec& z, const double* parameters) { return Belt{parameters[0], parameters[1], parameters[2], parameters[3]}(z); }

}  // namespace

double Belt::wound_per_turn() const { return 2 * std::numbers::pi * std::abs(w()); }

double Belt::run(const Planar::Vec& z) const {
  const double distance = std::hypot(z[0], z[1]), apart = std::abs(w());
  return distance > apart ? std::sqrt((distance - apart) * (distance + apart)) : 0;
}

GapFunction Belt::operator()(const Planar::Vec& z) const {
  GapFunction g;
  const double apart = std::abs(w()), t = run(z);
  const double a = std::atan2(z[1], z[0]) + (t > 0 || apart > 0 ? std::atan2(w(), t) : 0), c = std::cos(a), s = std::sin(a);  // (2.15)
  g.gap = t + w() * a - radius_second * z[2] - length;                                                                      // (2.16)
  if (const double whole = wound_per_turn(); whole > 0) g.gap -= whole * std::round((g.gap - stretch) / whole);
  g.gradient << c, s, -radius_second;
  if (!(t > 0)) return g;
  g.hessian(0, 0) = s * s / t;
  g.hessian(1, 1) = c * c / t;
  g.hessian(0, 1) = g.hessian(1, 0) = -s * c / t;
  return g;
}

FunctionGap function_of(const Belt& belt) { return {gap_at, {belt.radius_first, belt.radius_second, belt.length, belt.stretch}, belt.wound_per_turn()}; }

std::optional<Belt> belt_of(const JointDisplacement& displacement) {
  const auto* function = std::get_if<FunctionGap>(&displacement);
  if (!function || function->at != gap_at) return {};
  return Belt{function->parameters[0], function->parameters[1], function->parameters[2], function->parameters[3]};
}

bool is_at_end_of_range(const JointDisplacement& displacement, double gap) {
  constexpr double kNear = 0.03;  // as a fraction of the length wound per turn: distance from the place where the gap jumps to its other end
  const std::optional<Belt> belt = belt_of(displacement);
  return belt && belt->wound_per_turn() > 0 && std::abs(gap - belt->stretch) > (0.5 - kNear) * belt->wound_per_turn();
}

}  // namespace pintle
