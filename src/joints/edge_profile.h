// A curved edge, given as a height over a straight line, and the gap between it and a pin, roller or wheel above it. theory/cams section 4.
#pragma once

#include <optional>
#include <string>

#include "base/bends.h"
#include "joints/curve_gap.h"
#include "pintle/model.h"

namespace pintle {

/// x is measured along the x axis of the first marker.
class EdgeProfile {
 public:
  explicit EdgeProfile(const Edge& edge);

  double roller_radius() const { return edge_.roller_radius; }
  double from() const { return edge_.from; }
  double to() const { return edge_.to; }
  /// Bends of the height along x.
  const Bends& bends() const { return bends_; }
  /// The point at x, with derivatives by -x, so that the side above is the outer side.
  CurvePoint at(double x) const;
  /// x of the point nearest to c. Eq. (2.1)
  double nearest(const Planar::Point& c) const;
  /// The x nearest to the range from from() to to() at which the height or its slope is not a number, searched for as far outside as the range is long; none if all are numbers.
  std::optional<double> undefined_at() const;
  /// Why no roller can run along the edge; "" if one can.
  std::string fault() const;

 private:
  Edge edge_;
  double hollow_ = 0;  // the least radius of curvature on concave parts from from() to to() [m]
  Bends bends_;
};

}  // namespace pintle
