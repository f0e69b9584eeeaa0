// Where the equations change their formula: signed functions of the state, each with an owner. theory/time section 7.
#pragma once

#include <algorithm>
#include <span>

namespace pintle {

/// A border of a joint's law, or a kink or jump of an expression, at which its value changes sign.
struct SwitchingFunction {
  enum class Owner { kLaw, kDrive, kMotor, kForce };
  Owner owner = Owner::kLaw;
  int index = 0;      // of the joint (laws, drives), the load (motors) or the applied force
  int part = 0;       // of the joint's law; of an applied force: 0 fx, 1 fy, 2 torque
  int border = 0;     // of that part, or kink of the expression, counted from 0
  int direction = 0;  // +1: an event only if it turns positive; -1: only if it ceases to be positive; 0: both
  bool law_has_states = false;  // which a crossing may set
  bool is_reported = false;         // a crossing is listed among the events of the joint

  /// Whether a change from one value to the other is an event.
  bool is_event(double from, double to) const { return (from > 0) != (to > 0) && (direction == 0 || (direction > 0) == (to > 0)); }
  /// Whether it is an event at which a law sets its states.
  bool is_crossing(double from, double to) const { return law_has_states && is_event(from, to); }
};

/// Whether all values lie on the same sides.
inline bool same_sides(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return (x > 0) == (y > 0); });
}

}  // namespace pintle
