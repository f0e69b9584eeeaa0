#include "joints/cam_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pintle {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSmooth = 1e-3;  // of the radius: a change of slope [m/rad] that rounded numbers may make

Planar::Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

std::array<double, 3> CamProfile::radius(double angle) const {
  const std::array<double, 1> at{angle - kTurn * std::floor(angle / kTurn)};
  const std::array<double, 3> lift = cam_.lift.is_constant() ? std::array{cam_.lift.value({}), 0.0, 0.0} : cam_.lift.second_order(at, 0);
  return {cam_.base_radius + (cam_.flat ? 0 : cam_.roller_radius) + lift[0], lift[1], lift[2]};  // (1.1), (1.2)
}

CamProfile::Pitch CamProfile::pitch(double angle) const {
  const auto [r, d, dd] = radius(angle);
  const Planar::Point u = direction(angle), v = Planar::perp(u);
  return {r * u, d * u + r * v, (dd - r) * u + 2 * d * v};
}

double CamProfile::foot(const Planar::Point& c) const {
  constexpr int kMost = 20;
  double angle = std::atan2(c[1], c[0]);
  for (int i = 0; i < kMost; ++i) {
    const Pitch at = pitch(angle);
    const double bend = (c - at.p).dot(at.dd) - at.d.squaredNorm();
    if (!(bend < 0)) break;  // not near a nearest point
    const double step = -(c - at.p).dot(at.d) / bend;  // (2.1), by Newton
    angle += step;
    if (std::abs(step) < 1e-15 * (1 + std::abs(angle))) return angle;
    if (i > 8 && std::abs(step) < 1e-13) return angle;
  }
  return foot_by_search(c);
}

// The nearest of many points, then by halves between its neighbours.
double CamProfile::foot_by_search(const Planar::Point& c) const {
  constexpr int kPoints = 360, kHalves = 60;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPoints; ++i) {
    const double distance = (c - pitch(kTurn * i / kPoints).p).norm();
    if (distance < least) {
      least = distance;
      best = kTurn * i / kPoints;
    }
  }
  double low = best - kTurn / kPoints, high = best + kTurn / kPoints;
  for (int i = 0; i < kHalves; ++i) {
    const double middle = 0.5 * (low + high);
    const Pitch at = pitch(middle);
    ((c - at.p).dot(at.d) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

GapFunction CamGap::operator()(const Planar::Vec& z) const {
  GapFunction g;
  const Planar::Point c(z[0], z[1]);
  if (profile->cam_.flat) {
    const Planar::Point m(-std::sin(z[2]), std::cos(z[2])), along(std::cos(z[2]), std::sin(z[2]));
    const auto [h, d, dd] = profile->radius(z[2] + kTurn / 4);
    g.gap = c.dot(m) - h;                             // (2.5)
    g.gradient << m[0], m[1], -c.dot(along) - d;      // (2.6)
    g.hessian(0, 2) = g.hessian(2, 0) = -along[0];
    g.hessian(1, 2) = g.hessian(2, 1) = -along[1];
    g.hessian(2, 2) = -c.dot(m) - dd;
    return g;
  }
  const CamProfile::Pitch at = profile->pitch(profile->foot(c));
  const double speed = at.d.norm(), curvature = Planar::cross(at.d, at.dd) / (speed * speed * speed);
  const Planar::Point t = at.d / speed, n(t[1], -t[0]);
  g.gap = (c - at.p).dot(n);                          // (2.2)
  g.gradient << n[0], n[1], 0;                        // (2.3)
  g.hessian.topLeftCorner<2, 2>() = curvature / (1 + curvature * g.gap) * t * t.transpose();  // (2.4)
  return g;
}

Planar::Point CamProfile::surface(double angle) const {
  if (cam_.flat) {
    const auto [h, d, dd] = radius(angle);
    return h * direction(angle) + d * Planar::perp(direction(angle));  // (1.4)
  }
  const Pitch at = pitch(angle);
  const Planar::Point n(at.d[1], -at.d[0]);
  return at.p - cam_.roller_radius / n.norm() * n;  // (1.3)
}

double CamProfile::surface_curvature(double angle) const {
  if (cam_.flat) {
    const auto [h, d, dd] = radius(angle);
    return h + dd;  // (1.6)
  }
  const Pitch at = pitch(angle);
  const double speed = at.d.norm();
  return speed * speed * speed / Planar::cross(at.d, at.dd) - cam_.roller_radius;  // (1.5)
}

CamContactPlace CamProfile::place(const Planar::Vec& z) const {
  const double angle = std::remainder(cam_.flat ? z[2] + kTurn / 4 : foot({z[0], z[1]}), kTurn);
  if (cam_.flat) return {angle, 0};
  const Planar::Point d = pitch(angle).d;
  return {angle, std::remainder(std::atan2(-d[0], d[1]) - z[2] - kTurn / 4, kTurn)};  // (2.7)
}

// A kink of the lift between two angles at which its slope jumps; "" if there is none.
std::string CamProfile::corner_between(double low, double high) const {
  constexpr int kHalves = 50;
  const auto n = static_cast<std::size_t>(cam_.lift.n_switches());
  const auto signs = [&](double angle) {
    std::vector<double> value(n);
    cam_.lift.find_switching(std::array{angle}, value.data());
    return value;
  };
  const std::vector<double> at_low = signs(low), at_high = signs(high);
  for (std::size_t k = 0; k < n; ++k) {
    if ((at_low[k] > 0) == (at_high[k] > 0)) continue;
    double a = low, b = high;
    for (int i = 0; i < kHalves; ++i) {
      const double middle = 0.5 * (a + b);
      ((signs(middle)[k] > 0) == (at_low[k] > 0) ? a : b) = middle;
    }
    const double before = radius(a)[1], behind = radius(b)[1];
    if (std::abs(behind - before) > kSmooth * radius(a)[0]) return fmt::format("the cam has a corner at {:.4g} deg: the slope of the lift jumps from {:.4g} to {:.4g} m/rad", 360 * a / kTurn, before, behind);
  }
  return {};
}

std::string CamProfile::fault() const {
  constexpr int kPoints = 720;
  const std::array<double, 3> start = radius(0), end = radius(std::nextafter(kTurn, 0));
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kTurn * i / kPoints, degrees = 360.0 * i / kPoints;
    const auto [r, d, dd] = radius(angle);
    if (!std::isfinite(r) || !std::isfinite(d) || !std::isfinite(dd)) return fmt::format("the lift or a derivative of it is not finite at {:g} deg", degrees);
    if (!(r > 0)) return fmt::format("the radius at {:g} deg is {:.4g} m", degrees, r);
    if (i > 0 && !cam_.lift.is_constant())
      if (std::string corner = corner_between(kTurn * (i - 1) / kPoints, angle); !corner.empty()) return corner;
    const double curvature = surface_curvature(angle), roller = cam_.roller_radius;
    if (cam_.flat && !(curvature > 0)) return fmt::format("at {:g} deg the cam would be hollow (radius of curvature {:.4g} m), and a flat face cannot follow it", degrees, curvature);
    if (!cam_.flat && roller > 0 && curvature > -roller && curvature <= 0)
      return fmt::format("at {:g} deg the pitch curve is bent more than the roller (radius of curvature {:.4g} m): the cam would be undercut", degrees, curvature + roller);
  }
  constexpr double kClosed = 1e-6;  // of the radius: what rounded numbers in a model may be off
  if (std::abs(end[0] - start[0]) > kClosed * start[0]) return fmt::format("the profile does not close: after a turn the lift is {:.4g} m higher", end[0] - start[0]);
  if (std::abs(end[1] - start[1]) > kSmooth * start[0]) return fmt::format("the profile has a corner where it closes: its slope changes from {:.4g} to {:.4g} m/rad", end[1], start[1]);
  return {};
}

}  // namespace pintle
