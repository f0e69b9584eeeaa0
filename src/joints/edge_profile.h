// A curved edge, a height over a straight line, and the gap between it and a pin, roller or wheel above it. theory/cams section 4.
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
  /// Along x.
  const Bends& bends() const { return bends_; }
  /// The point at x, with derivatives by -x: what is above it is on the outer side.
  CurvePoint at(double x) const;
  /// x of the point that is nearest to c. Eq. (2.1)
  double nearest(const Planar::Point& c) const;
  /// The x nearest to its stretch from from() to to() at which the height or its slope is not a number, as far outside as the stretch is long; none if all are numbers.
  std::optional<double> undefined_at() const;
  /// Why no roller can run along it; "" if one can.
  std::string fault() const;

 private:
  Edge edge_;
  double hollow_ = 0;  // the least radius of curvature of hollow parts from from() to to() [m]
  Bends bends_;
};

}  // namespace pintle
