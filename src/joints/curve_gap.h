// A point on the outer side of a plane curve: its distance from the curve, the nearest point, and its slip along the curve. theory/cams sections 2 and 4.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "joints/gap_function.h"
#include "pintle/expression.h"

namespace pintle {

/// A point of a curve with its derivatives by the parameter. The outer side is on the right of d.
struct CurvePoint {
  Planar::Point p, d, dd;

  Planar::Point tangent() const { return d.normalized(); }
  Planar::Point normal() const { return {tangent()[1], -tangent()[0]}; }
  /// 1/m, positive where the curve is convex as seen from outside.
  double curvature() const { return Planar::cross(d, dd) / (d.squaredNorm() * d.norm()); }
};

/// For a point c and the curve's point nearest to it. Component 0 is the distance of c from the curve, Eqs. (2.2)-(2.4). Component 1 is the speed along the
/// curve, in the direction of d, of the surface of a disc of this radius about c, Eq. (2.8). This slip is not the rate of a function of the pose: its value
/// is 0, and the derivative of its gradient, row i by z_k, is not symmetric.
std::array<GapFunction, 2> gap_and_slip_over(const CurvePoint& nearest, const Planar::Point& c, double radius);

/// Newton's method for (c - P) P' = 0, Eq. (2.1), from a parameter near the nearest point; none if it does not converge to one.
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

/// Points of a closed curve at multiples of `spacing` of its parameter, for one period.
struct CurveTable {
  double spacing = 0;
  std::vector<Planar::Point> points;

  const Planar::Point& point(std::ptrdiff_t i) const {
    const auto n = static_cast<std::ptrdiff_t>(points.size());
    return points[static_cast<std::size_t>((i % n + n) % n)];
  }
};

/// The same, starting from the nearest of sample points between two parameters, at most `apart` from each other; by bisection between that point's
/// neighbours if Newton's method leaves this interval. point(parameter) is the curve's point alone; the samples are those of the table if it is fine enough.
template <class Curve, class Point>
double nearest_by_sampling(const Curve& curve, const Point& point, const Planar::Point& c, double low, double high, double apart, const CurveTable& table) {
  constexpr double kMost = 360;  // intervals
  constexpr int kHalves = 60;
  const double intervals = std::ceil(std::clamp((high - low) / apart, 1.0, kMost));
  apart = (high - low) / intervals;
  double best = low, least = std::numeric_limits<double>::infinity();
  const auto see = [&](double parameter, const Planar::Point& sample) {
    const double square = (c - sample).squaredNorm();
    if (!(square < least)) return;
    least = square;
    best = parameter;
  };
  if (!table.points.empty() && apart >= table.spacing) {
    const auto stride = static_cast<std::ptrdiff_t>(apart / table.spacing), last = static_cast<std::ptrdiff_t>(std::ceil(high / table.spacing));
    for (auto i = static_cast<std::ptrdiff_t>(std::floor(low / table.spacing)); i < last + stride; i += stride) see(static_cast<double>(i) * table.spacing, table.point(i));
    apart = static_cast<double>(stride) * table.spacing;
  } else {
    for (double i = 0; i <= intervals; ++i) see(low + apart * i, point(low + apart * i));
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

/// The least radius of curvature on a curve's concave parts between two parameters [m]. A point nearer to the curve than this has one
/// nearest point, which Newton's method finds; farther away another point may be nearer. Infinite if no part is concave.
template <class Curve>
double least_hollow_radius(const Curve& curve, double low, double high) {
  constexpr int kPoints = 720;
  double most = 0;
  for (int i = 0; i <= kPoints; ++i) most = std::max(most, -curve(low + (high - low) * i / kPoints).curvature());
  return 1 / most;
}

/// The parameter of the point nearest to c, Eq. (2.1): by Newton's method from the parameter of the point `below` c, and where another point may be
/// nearer, or Newton's method fails, from the nearest of many samples. `hollow` is the least_hollow_radius; half_range(distance) is how far from `below`
/// the parameter of a point within that distance of c may be. `table` may be empty.
template <class Curve, class Point, class HalfRange>
double nearest_parameter(const Curve& curve, const Point& point, const Planar::Point& c, double below, double hollow, const HalfRange& half_range, const CurveTable& table) {
  constexpr double kSurely = 0.9;  // as a fraction of the least hollow radius, which is known at some points only
  constexpr double kPart = 0.25;  // largest distance of sample points, as a fraction of it. Of the 4500 points of edge_profile_test one is given a point that is not the nearest with 0.5, and 13 with 2
  const std::optional<double> found = nearest_by_newton(curve, c, below);
  const double distance = (c - point(found ? *found : below)).norm();
  if (found && distance < kSurely * hollow) return *found;
  const double sampled = nearest_by_sampling(curve, point, c, below - half_range(distance), below + half_range(distance), half_range(kPart * hollow), table);
  return found && distance < (c - point(sampled)).norm() ? *found : sampled;
}

/// Where the slope of a function of one variable jumps by more than `least` between two places, with the slopes on either side; none if it does not.
struct Corner {
  double at, slope_before, slope_behind;
};
std::optional<Corner> corner_between(const Expression& f, double low, double high, double least);

}  // namespace pintle
