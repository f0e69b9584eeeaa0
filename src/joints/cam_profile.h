// The profile of a cam, as a lift over its base circle, and the gap between it and its follower. theory/cams
#pragma once

#include <array>
#include <string>

#include "base/bends.h"
#include "joints/curve_gap.h"
#include "pintle/model.h"

namespace pintle {

struct CamContactPlace {
  double angle = 0, pressure_angle = 0;
};

/// Polar angles are measured on the cam, from the x axis of its marker, counter-clockwise.
class CamProfile {
 public:
  explicit CamProfile(const Cam& cam);

  bool flat() const { return cam_.flat; }
  /// Radius [m] with its first and second derivatives by the angle. For a roller or pin: the polar radius of the pitch curve, the path of its
  /// centre around the cam, Eq. (1.1). For a flat face: its distance from the cam's axis when the angle is that of its normal, Eq. (1.2).
  std::array<double, 3> radius(double angle) const;
  /// Bends of the radius as a function of the angle, with the period of a turn.
  const Bends& bends() const { return bends_; }
  /// The polar angle of the point of the pitch curve nearest to c, Eq. (2.1).
  double foot(const Planar::Point& c) const;
  /// A point of the cam's surface, Eqs. (1.3), (1.4); the angle is the argument of radius().
  Planar::Point surface(double angle) const;
  /// Radius of curvature of the surface there, Eqs. (1.5), (1.6) [m]. If it is not positive on a convex part, the follower cannot follow.
  double surface_curvature(double angle) const;
  /// The position of the follower at a relative pose: polar angle, Eq. (2.1), and the angle from the y axis of its marker to the normal, Eq. (2.7) [rad].
  CamContactPlace place(const Planar::Vec& z) const;
  /// Why no follower can run on the profile; "" if one can.
  std::string fault() const;

 private:
  double zero_lift_radius() const { return cam_.base_radius + (cam_.flat ? 0 : cam_.roller_radius); }
  CurvePoint pitch(double angle) const;

  friend struct CamGap;
  Cam cam_;
  double hollow_;  // the least radius of curvature on the concave parts of the pitch curve [m]
  Bends bends_;
  CurveTable table_;  // of the pitch curve, if it has concave parts
};

}  // namespace pintle
