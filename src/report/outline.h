// Plane geometry for outlines of bodies.
#pragma once

#include <array>
#include <vector>

#include "pintle/model.h"

namespace pintle {

inline Vec2 operator+(const Vec2& a, const Vec2& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline Vec2 operator-(const Vec2& a, const Vec2& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline Vec2 operator*(double f, const Vec2& a) { return {f * a[0], f * a[1]}; }
inline double dot(const Vec2& a, const Vec2& b) { return a[0] * b[0] + a[1] * b[1]; }
inline double cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }
inline Vec2 normal(const Vec2& a) { return {-a[1], a[0]}; }  ///< turned by +90 degrees
double length(const Vec2& a);
Vec2 direction(double angle);
Vec2 unit(const Vec2& a);  ///< of length 1; {1, 0} for a zero vector

/// The corners of the convex hull, counter-clockwise. Points less than `flat` off a line count as lying on it, so of
/// points in a row only the two ends remain.
std::vector<Vec2> convex_hull(std::vector<Vec2> points, double flat);

Vec2 nearest_on(const Vec2& from, const Vec2& to, const Vec2& p);

/// A rectangle around `centre`; `half` has half its side lengths along and across `along` (of length 1).
std::vector<Vec2> rectangle(const Vec2& centre, const Vec2& along, const Vec2& half);

/// Points on the cubic curve from `a` to `b` with these tangents at its ends (Hermite).
std::vector<Vec2> cubic_curve(const Vec2& a, const Vec2& along_a, const Vec2& b, const Vec2& along_b);

/// Points on an arc, from angle `from` to `to`.
std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double to);

}  // namespace pintle
