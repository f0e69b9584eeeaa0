// The displacements along which springs, motors and applied forces act.
#pragma once

#include "system/system.h"

namespace pintle {

/// An applied force along an axis of its body: its frames are in reverse order, the point on the body first and the ground second.
template <class S>
bool acts_in_body_axes(const BasicLoadData<S>& load) { return load.applied && load.at.b == kGround; }

/// Displacement of a body's point along an axis of the body: component parameters[0] of the point's frame F, from the pose of the ground in it. Its rate
/// is the velocity of F's origin, which is not the rate of a function of the pose, so its value is 0 and the derivative of its gradient is not symmetric.
/// theory/joints Eq. (4.8)
inline GapFunction way_in_body_axes(const Planar::Vec& z, const double* parameters) {
  GapFunction g;
  const bool along_y = parameters[0] > 0;
  g.gradient << (along_y ? 0 : -1), (along_y ? -1 : 0), (along_y ? z[0] : -z[1]);
  g.hessian(2, along_y ? 0 : 1) = along_y ? 1 : -1;
  return g;
}

template <class S>
BasicDisplacement<S> displacement_of(const BasicLoadData<S>& load) {
  if (load.kind == LoadKind::kSpring) return BasicDistance<S>{load.free};
  if constexpr (std::is_same_v<S, Planar>)
    if (acts_in_body_axes(load)) return FunctionGap{way_in_body_axes, {static_cast<double>(load.component)}};
  return BasicSelection<S>{typename S::Vec(S::Vec::Unit(load.component) * (load.kind == LoadKind::kTorsionSpring ? load.free : 0.0))};
}

/// The component of its displacement along which the load acts.
template <class S>
int slot_of(const BasicLoadData<S>& load) { return load.kind == LoadKind::kSpring || acts_in_body_axes(load) ? 0 : load.component; }

}  // namespace pintle
