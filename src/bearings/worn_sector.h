// The most worn sector of a bush or pin. theory/bearing_life section 5.
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

namespace pintle {

struct WornSector {
  double work;    // [N*m]
  double middle;  // its middle from the axis, in sectors
  double n;       // number of sectors around

  double width() const { return 2 * std::numbers::pi / n; }      // [rad]
  double angle() const { return width() * middle; }              // angle of its middle [rad]
  double degrees() const { return middle * 360 / n; }
};

inline WornSector most_worn(const std::vector<double>& sectors) {
  const auto most = std::max_element(sectors.begin(), sectors.end());
  return {*most, static_cast<double>(most - sectors.begin()) + 0.5, static_cast<double>(sectors.size())};
}

}  // namespace pintle
