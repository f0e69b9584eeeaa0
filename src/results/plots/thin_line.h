// Thins a curve of a million points to a few thousand without visible change.
#pragma once

#include <vector>

namespace pintle {

struct Point {
  double x = 0, y = 0;
};

/// The points [px] without those that are invisible. If x rises throughout, each column of `column_width` keeps
/// its first, lowest, highest and last point, so that no peak is lost; otherwise points closer than that to the last
/// kept one are dropped. Of consecutive points that are not finite one is kept, which interrupts the line.
std::vector<Point> thin_line(const std::vector<Point>& points, double column_width);

}  // namespace pintle
