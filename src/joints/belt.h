// A free run of a belt, or of a rope that winds onto a drum: it touches a disc about each of two markers and does not slip on them.
//
//   u = (cos a, sin a),  a = psi + atan2(w, t),  w = r2 - r1,  t = sqrt(D^2 - w^2)       theory/joints Eq. (2.15)
//   gap = t + w a - r2 z_3 - length                                                      Eq. (2.16)
//
// (D, psi) is the place of the second disc in polar coordinates; a radius is positive where the run lies on the left of its disc, seen from the first
// to the second, and 0 where it ends in the marker. t is the length of the run; what the discs wind and unwind is the rest.
#pragma once

#include <optional>

#include "joints/joint_displacement.h"

namespace pintle {

struct Belt {
  double radius_first = 0, radius_second = 0;  // r1, r2, signed [m]
  double length = 0;                           // of the belt, less what is wound where all angles are 0 [m]
  double stretch = 0;                          // as assembled [m]

  double w() const { return radius_second - radius_first; }
  /// What a whole turn of one disc about the other winds [m]. Angles are known up to full turns, so the gap is up to this, next to the stretch as assembled: methods that
  /// carry gaps count from there, count_turns.
  double wound_per_turn() const;
  /// t, 0 where there is no way between the discs [m].
  double run(const Planar::Vec& z) const;
  GapFunction operator()(const Planar::Vec& z) const;
};

/// As a displacement, a function of the pose like those of joint types from outside.
FunctionGap function_of(const Belt& belt);
/// The belt that a displacement is, or nullopt.
std::optional<Belt> belt_of(const JointDisplacement& displacement);

/// Whether a belt is stretched or slack nearly as far as the one is told from the other where turns are not counted.
bool is_at_end_of_range(const JointDisplacement& displacement, double gap);
/// Joints of other kinds count turns, or have none.
template <class Displacement>
bool is_at_end_of_range(const Displacement&, double) { return false; }

}  // namespace pintle
