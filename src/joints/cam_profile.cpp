#include "joints/cam_profile.h"

#include <fmt/format.h>

#include <cmath>

#include "base/constants.h"

namespace pintle {
namespace {

constexpr double kSmooth = 1e-3;  // as a fraction of the radius: largest change of slope [m/rad] that rounded numbers may cause

Planar::Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
std::array<double, 1> in_turn(double angle) { return {angle - kTurn * std::floor(angle / kTurn)}; }

}  // namespace

CamProfile::CamProfile(const Cam& cam) : cam_(cam), hollow_(least_hollow_radius([this](double angle) { return pitch(angle); }, 0, kTurn)), bends_(find_bends([this](double angle) { return radius(angle)[2]; }, 0, kTurn)) {
  bends_.period = kTurn;
  if (cam_.flat || !std::isfinite(hollow_)) return;
  constexpr int kPoints = 1440;  // four for each interval of the search at most. With half of them those of a pin-pallet escapement are too far apart, which doubles its time; twice as many change nothing
  table_.spacing = kTurn / kPoints;
  for (int i = 0; i < kPoints; ++i) table_.points.push_back(pitch(i * table_.spacing).p);
}

std::array<double, 3> CamProfile::radius(double angle) const {
  const std::array<double, 3> lift = cam_.lift.is_constant() ? std::array{cam_.lift.value({}), 0.0, 0.0} : cam_.lift.second_order(in_turn(angle), 0);
  return {zero_lift_radius() + lift[0], lift[1], lift[2]};  // (1.1), (1.2)
}

CurvePoint CamProfile::pitch(double angle) const {
  const auto [r, d, dd] = radius(angle);
  const Planar::Point u = direction(angle), v = Planar::perp(u);
  return {r * u, d * u + r * v, (dd - r) * u + 2 * d * v};
}

// Points of the curve within the distance `way` of c are seen from the axis within this angle of c.
double CamProfile::foot(const Planar::Point& c) const {
  const auto sight = [&c](double way) { return way < c.norm() ? std::asin(way / c.norm()) : kTurn / 2; };
  const auto point = [this](double angle) { return Planar::Point((zero_lift_radius() + cam_.lift.value(in_turn(angle))) * direction(angle)); };
  return nearest_parameter([this](double angle) { return pitch(angle); }, point, c, std::atan2(c[1], c[0]), hollow_, sight, table_);
}

std::array<GapFunction, 2> CamGap::gap_and_slip(const Planar::Vec& z) const {
  const Planar::Point c(z[0], z[1]);
  if (!profile->cam_.flat) return gap_and_slip_over(profile->pitch(profile->foot(c)), c, profile->cam_.roller_radius);
  std::array<GapFunction, 2> g;
  const Planar::Point m(-std::sin(z[2]), std::cos(z[2])), along(std::cos(z[2]), std::sin(z[2]));
  const auto [h, d, dd] = profile->radius(z[2] + kTurn / 4);
  g[0].gap = c.dot(m) - h;                                    // (2.5)
  g[0].gradient << m[0], m[1], -c.dot(along) - d;             // (2.6)
  g[0].hessian(0, 2) = g[0].hessian(2, 0) = -along[0];
  g[0].hessian(1, 2) = g[0].hessian(2, 1) = -along[1];
  g[0].hessian(2, 2) = -c.dot(m) - dd;
  g[1].gradient << along[0], along[1], g[0].gap;              // (2.9)
  g[1].hessian.row(2) = g[0].gradient.transpose();
  g[1].hessian(0, 2) = m[0];
  g[1].hessian(1, 2) = m[1];
  return g;
}

Planar::Point CamProfile::surface(double angle) const {
  if (cam_.flat) {
    const auto [h, d, dd] = radius(angle);
    return h * direction(angle) + d * Planar::perp(direction(angle));  // (1.4)
  }
  const CurvePoint at = pitch(angle);
  return at.p - cam_.roller_radius * at.normal();  // (1.3)
}

double CamProfile::surface_curvature(double angle) const {
  if (cam_.flat) {
    const auto [h, d, dd] = radius(angle);
    return h + dd;  // (1.6)
  }
  return 1 / pitch(angle).curvature() - cam_.roller_radius;  // (1.5)
}

CamContactPlace CamProfile::place(const Planar::Vec& z) const {
  const double angle = std::remainder(cam_.flat ? z[2] + kTurn / 4 : foot({z[0], z[1]}), kTurn);
  if (cam_.flat) return {angle, 0};
  const Planar::Point n = pitch(angle).normal();
  return {angle, std::remainder(std::atan2(n[1], n[0]) - z[2] - kTurn / 4, kTurn)};  // (2.7)
}

std::string CamProfile::fault() const {
  constexpr int kPoints = 720;
  const std::array<double, 3> start = radius(0), end = radius(std::nextafter(kTurn, 0));
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kTurn * i / kPoints, degrees = 360.0 * i / kPoints;
    const auto [r, d, dd] = radius(angle);
    if (!std::isfinite(r) || !std::isfinite(d) || !std::isfinite(dd)) return fmt::format("the lift or a derivative of it is not finite at {:g} deg", degrees);
    if (!(r > 0)) return fmt::format("the radius at {:g} deg is {:.4g} m", degrees, r);
    if (!cam_.lift.is_constant())
      if (const auto corner = corner_between(cam_.lift, angle, kTurn * (i + 1) / kPoints, kSmooth * r))
        return fmt::format("the cam has a corner at {:.4g} deg: the slope of the lift jumps from {:.4g} to {:.4g} m/rad", 360 * corner->at / kTurn, corner->slope_before, corner->slope_behind);
    const double curvature = surface_curvature(angle), roller = cam_.roller_radius;
    if (cam_.flat && !(curvature > 0)) return fmt::format("at {:g} deg the cam would be hollow (radius of curvature {:.4g} m), and a flat face cannot follow it", degrees, curvature);
    if (!cam_.flat && roller > 0 && curvature > -roller && curvature <= 0)
      return fmt::format("at {:g} deg the pitch curve is bent more than the roller (radius of curvature {:.4g} m): the cam would be undercut", degrees, curvature + roller);
  }
  constexpr double kClosed = 1e-6;  // as a fraction of the radius: tolerance for rounded numbers in a model
  if (std::abs(end[0] - start[0]) > kClosed * start[0]) return fmt::format("the profile does not close: after a turn the lift is {:.4g} m higher", end[0] - start[0]);
  if (std::abs(end[1] - start[1]) > kSmooth * start[0]) return fmt::format("the profile has a corner where it closes: its slope changes from {:.4g} to {:.4g} m/rad", end[1], start[1]);
  return {};
}

}  // namespace pintle
