// Thins a curve of a million points to a few thousand without visible change.
#pragma once

#include <vector>

namespace pintle {

struct Point {
  double x = 0, y = 0;
};

/// Points [px] with those left out that cannot be seen. Where x rises throughout, each column of `column_width` keeps
/// its first, lowest, highest and last point, so that no peak is lost; otherwise points closer than that to the last
/// kept one are dropped. Points that are not finite are kept, once in a row: they interrupt the line.
std::vector<Point> thin_line(const std::vector<Point>& points, double column_width);

}  // namespace pintle
