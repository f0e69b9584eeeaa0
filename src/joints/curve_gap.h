// What is on the outer side of a plane curve: its distance, the nearest point, and how it slips along. theory/cams sections 2 and 4.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "joints/gap_function.h"
#include "pintle/expression.h"

namespace pintle {

/// A point of a curve with its derivatives by the parameter. The outer side is on the right of d.
struct CurvePoint {
  Planar::Point p, d, dd;

  Planar::Point tangent() const { return d.normalized(); }
  Planar::Point normal() const { return {tangent()[1], -tangent()[0]}; }
  /// 1/m, positive where it is convex as seen from outside.
  double curvature() const { return Planar::cross(d, dd) / (d.squaredNorm() * d.norm()); }
};

/// Of a point c and the curve's nearest one to it: component 0 how far it is from the curve, Eqs. (2.2)-(2.4); component 1 the speed along the curve, in
/// the direction of d, of the surface of a disc of this radius about c, Eq. (2.8). It is of a slip, which is no rate of a function of the pose: its value is
/// 0, and the derivative of its gradient, row i by z_k, not symmetric.
std::array<GapFunction, 2> gap_and_slip_over(const CurvePoint& nearest, const Planar::Point& c, double radius);

/// Newton's method for (c - P) P' = 0, Eq. (2.1), from a parameter near the nearest point; none where it does not lead to one.
template <class Curve>
std::optional<double> nearest_by_newton(const Curve& curve, const Planar::Point& c, double parameter) {
  constexpr int kMost = 20, kMany = 8;
  for (int i = 0; i < kMost; ++i) {
    const CurvePoint at = curve(parameter);
    const double bend = (c - at.p).dot(at.dd) - at.d.squaredNorm();
    if (!(bend < 0)) return {};  // not near a nearest point
    const double step = -(c - at.p).dot(at.d) / bend;
    parameter += step;
    if (std::abs(step) < 1e-15 * (1 + std::abs(parameter)) || (i > kMany && std::abs(step) < 1e-13)) return parameter;
  }
  return {};
}

/// The same from the nearest of points between two parameters that are no further than `apart` from each other, by halves between its neighbours where
/// Newton's method does not stay there. point(parameter) is the curve's point alone.
template <class Curve, class Point>
double nearest_by_sampling(const Curve& curve, const Point& point, const Planar::Point& c, double low, double high, double apart) {
  constexpr double kMost = 360;  // intervals
  constexpr int kHalves = 60;
  const double intervals = std::ceil(std::clamp((high - low) / apart, 1.0, kMost));
  apart = (high - low) / intervals;
  double best = low, least = std::numeric_limits<double>::infinity();
  for (double i = 0; i <= intervals; ++i)
    if (const double square = (c - point(low + apart * i)).squaredNorm(); square < least) {
      least = square;
      best = low + apart * i;
    }
  if (const std::optional<double> found = nearest_by_newton(curve, c, best); found && std::abs(*found - best) < apart) return *found;
  double before = best - apart, behind = best + apart;
  for (int i = 0; i < kHalves; ++i) {
    const double middle = 0.5 * (before + behind);
    const CurvePoint at = curve(middle);
    ((c - at.p).dot(at.d) > 0 ? before : behind) = middle;
  }
  return 0.5 * (before + behind);
}

/// The least radius of curvature of a curve's hollow parts between two parameters [m]: what is nearer to the curve has one nearest point,
/// which Newton's method finds; further away there may be another one that is nearer. Infinite where nothing is hollow.
template <class Curve>
double least_hollow_radius(const Curve& curve, double low, double high) {
  constexpr int kPoints = 720;
  double most = 0;
  for (int i = 0; i <= kPoints; ++i) most = std::max(most, -curve(low + (high - low) * i / kPoints).curvature());
  return 1 / most;
}

/// The parameter of the point that is nearest to c, Eq. (2.1): by Newton's method from that of the point `below` c, and where another point may be
/// nearer, or Newton's method fails, from the nearest of many. `hollow` is the least_hollow_radius; half_range(distance) is how far from `below` a point's
/// parameter may be if it is no further from c than that.
template <class Curve, class Point, class HalfRange>
double nearest_parameter(const Curve& curve, const Point& point, const Planar::Point& c, double below, double hollow, const HalfRange& half_range) {
  constexpr double kSurely = 0.9;  // of the least hollow radius, which is that at some points only
  constexpr double kPart = 0.25;  // of it: how far apart points are looked at. Of the 4500 of edge_profile_test one is given a point that is not the nearest with 0.5, and 13 with 2
  const std::optional<double> found = nearest_by_newton(curve, c, below);
  const double distance = (c - point(found ? *found : below)).norm();
  if (found && distance < kSurely * hollow) return *found;
  const double sampled = nearest_by_sampling(curve, point, c, below - half_range(distance), below + half_range(distance), half_range(kPart * hollow));
  return found && distance < (c - point(sampled)).norm() ? *found : sampled;
}

/// Where the slope of a function of one variable jumps by more than `least` between two places, with the slopes on either side; none: nowhere.
struct Corner {
  double at, slope_before, slope_behind;
};
std::optional<Corner> corner_between(const Expression& f, double low, double high, double least);

}  // namespace pintle
