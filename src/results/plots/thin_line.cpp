#include "results/plots/thin_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pintle {
namespace {

bool finite(const Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

bool rises(const std::vector<Point>& points) {
  return std::is_sorted(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
}

/// Appends the points needed from one column of points [begin, end), all finite.
void append_column(const std::vector<Point>& points, std::size_t begin, std::size_t end, std::vector<Point>& kept) {
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = points.begin() + static_cast<std::ptrdiff_t>(end);
  const auto [low, high] = std::minmax_element(first, last, [](const Point& a, const Point& b) { return a.y < b.y; });
  std::array<std::size_t, 4> chosen{begin, static_cast<std::size_t>(low - points.begin()),
                                    static_cast<std::size_t>(high - points.begin()), end - 1};
  std::sort(chosen.begin(), chosen.end());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (i == 0 || chosen[i] != chosen[i - 1]) kept.push_back(points[chosen[i]]);
}

std::vector<Point> thin_rising(const std::vector<Point>& points, double column_width) {
  std::vector<Point> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    if (finite(points[begin])) {
      const double column = std::floor(points[begin].x / column_width);
      while (end < points.size() && finite(points[end]) && std::floor(points[end].x / column_width) == column) ++end;
      append_column(points, begin, end, kept);
    } else {
      while (end < points.size() && !finite(points[end])) ++end;
      kept.push_back(points[begin]);
    }
    begin = end;
  }
  return kept;
}

std::vector<Point> thin_wandering(const std::vector<Point>& points, double distance) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool interrupts = !finite(points[i]);
    const bool first = kept.empty() || finite(kept.back()) == interrupts;
    const bool last = i + 1 == points.size() || finite(points[i + 1]) == interrupts;
    if (interrupts ? first
                   : first || last || std::hypot(points[i].x - kept.back().x, points[i].y - kept.back().y) > distance)
      kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

std::vector<Point> thin_line(const std::vector<Point>& points, double column_width) {
  return rises(points) ? thin_rising(points, column_width) : thin_wandering(points, column_width);
}

}  // namespace pintle
