#include "report/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cubic_hermite.h"

namespace pintle {

double length(const Vec2& a) { return std::hypot(a[0], a[1]); }

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

Vec2 unit(const Vec2& a) {
  const double l = length(a);
  return l > 0 ? Vec2{a[0] / l, a[1] / l} : Vec2{1, 0};
}

Vec2 nearest_on(const Vec2& from, const Vec2& to, const Vec2& p) {
  const Vec2 d = to - from;
  const double l2 = dot(d, d);
  return l2 > 0 ? from + std::clamp(dot(p - from, d) / l2, 0.0, 1.0) * d : from;
}

namespace {

/// One half of the hull of sorted points by Andrew's algorithm, without its last point.
std::vector<Vec2> half_hull(const std::vector<Vec2>& sorted) {
  std::vector<Vec2> chain;
  for (const Vec2& p : sorted) {
    while (chain.size() >= 2 && cross(chain.back() - chain[chain.size() - 2], p - chain[chain.size() - 2]) <= 0) chain.pop_back();
    chain.push_back(p);
  }
  chain.pop_back();
  return chain;
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points, double flat) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // The two points farthest apart give the axis; if all points are within `flat` of it, the outline is a bar.
  Vec2 a = points.front(), b = points.back();
  for (const Vec2& p : points)
    for (const Vec2& q : points)
      if (length(p - q) > length(a - b)) a = p, b = q;
  const Vec2 n = normal(unit(b - a));
  if (std::all_of(points.begin(), points.end(), [&](const Vec2& p) { return std::abs(dot(p - a, n)) <= flat; })) return {a, b};
  std::vector<Vec2> hull = half_hull(points);
  std::reverse(points.begin(), points.end());
  for (const Vec2& p : half_hull(points)) hull.push_back(p);
  return hull;
}

std::vector<Vec2> rectangle(const Vec2& centre, const Vec2& along, const Vec2& half) {
  const Vec2 u = half[0] * along, v = half[1] * normal(along);
  return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

std::vector<Vec2> cubic_curve(const Vec2& a, const Vec2& along_a, const Vec2& b, const Vec2& along_b) {
  constexpr int kPieces = 16;
  std::vector<Vec2> points;
  for (int i = 0; i <= kPieces; ++i) {
    points.push_back(cubic_hermite(static_cast<double>(i) / kPieces, 1, a, along_a, b, along_b));
  }
  return points;
}

std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double to) {
  const int n = std::max(4, static_cast<int>(std::ceil(std::abs(to - from) * 12 / std::numbers::pi)));
  std::vector<Vec2> points;
  for (int i = 0; i <= n; ++i) points.push_back(centre + radius * direction(from + (to - from) * i / n));
  return points;
}

}  // namespace pintle
