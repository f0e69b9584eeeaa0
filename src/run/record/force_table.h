// The joint forces of one integration at the output times, for comparison with another and for summaries.
#pragma once

#include <cmath>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
struct BasicForceTable {
  std::vector<double> t;     // [s]
  std::vector<double> step;  // the integration step that the time lies in or ends; 0 at the start [s]
  PositionsOf<S> place;   // row-major: per time, per body
  VecsOf<S> velocity;     // the same, if it is kept
  VecsOf<S> world;        // row-major: per time, per joint: force [N] and couple [N*m] on the second body, as `joint_load` gives them
  double largest_load = 0;   // on a body, over all steps, from LoadScale; 0 for methods without one [N]
  double rounding = 0;       // roundoff of the positions times the largest stiffness: forces below it are nothing else [N]
  double rounding_couple = 0;  // the same for angles and couples [N*m]
};
using ForceTable = BasicForceTable<Planar>;

/// A joint's force on its second body in world axes, and its couple about the second frame's origin [N, N*m]. `force` is conjugate to its gap.
template <class S>
typename S::Vec joint_load(const BasicSystem<S>& system, int j, const std::vector<typename S::Motion>& m, const typename S::Vec& force);

/// Whether the joint's law can transmit a couple: it holds an angle, or stops it.
template <class S>
bool transmits_couple(const BasicJointData<S>& joint);
/// Whether the joint has a couple at all: it transmits one, rubs, or is a servo.
template <class S>
bool has_couple(const BasicJointData<S>& joint);

template <int n>
double magnitude(const double* x) {
  static_assert(n >= 1 && n <= 3);
  if constexpr (n == 1) return std::abs(x[0]);
  else if constexpr (n == 2) return std::hypot(x[0], x[1]);
  else return std::hypot(x[0], x[1], x[2]);
}
/// Magnitudes of the translation (or force) and of the rotation (or couple) in a vector of S.
template <class S>
double linear_magnitude(const typename S::Vec& x) { return magnitude<S::kDim>(x.data()); }
template <class S>
double angular_magnitude(const typename S::Vec& x) { return magnitude<S::kDof - S::kDim>(x.data() + S::kDim); }

}  // namespace pintle
