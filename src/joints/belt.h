// A free run of a belt, or of a rope that winds onto a drum: tangent to a disc about each of two markers, without slip.
//
//   u = (cos a, sin a),  a = psi + atan2(w, t),  w = r2 - r1,  t = sqrt(D^2 - w^2)       theory/joints Eq. (2.15)
//   gap = t + w a - r2 z_3 - length                                                      Eq. (2.16)
//
// (D, psi) is the position of the second disc in polar coordinates. A radius is positive if the run lies on the left of its disc, seen from the first
// to the second, and 0 if the run ends in the marker. t is the length of the run; the other terms are what the discs wind and unwind.
#pragma once

#include <optional>

#include "joints/joint_displacement.h"

namespace pintle {

struct Belt {
  double radius_first = 0, radius_second = 0;  // r1, r2, signed [m]
  double length = 0;                           // of the belt, less what is wound when all angles are 0 [m]
  double stretch = 0;                          // as assembled [m]

  double w() const { return radius_second - radius_first; }
  /// Length wound by a whole turn of one disc about the other [m]. Angles are known up to full turns, so the gap is known up to multiples of this length; the value
  /// nearest to the stretch as assembled is taken. Methods that carry gaps count turns from there, count_turns.
  double wound_per_turn() const;
  /// t, 0 where there is no tangent between the discs [m].
  double run(const Planar::Vec& z) const;
  GapFunction operator()(const Planar::Vec& z) const;
};

/// The belt as a displacement: a function of the pose like those of externally registered joint types.
FunctionGap function_of(const Belt& belt);
/// The belt described by a displacement, or nullopt.
std::optional<Belt> belt_of(const JointDisplacement& displacement);

/// Whether a belt is so stretched or so slack that, without counting turns, the two can hardly be distinguished.
bool is_at_end_of_range(const JointDisplacement& displacement, double gap);
/// Joints of other kinds count turns, or have none to count.
template <class Displacement>
bool is_at_end_of_range(const Displacement&, double) { return false; }

}  // namespace pintle
