// What springs, motors and applied forces act along.
#pragma once

#include "system/system.h"

namespace pintle {

/// An applied force along an axis of its body: its frames stand the other way round, the point on the body first and the ground second.
template <class S>
bool acts_in_body_axes(const BasicLoadData<S>& load) { return load.applied && load.at.b == kGround; }

/// The way of a body's point along an axis of the body, component parameters[0] of the point's frame F, from the pose of the ground in it: the velocity of
/// F's origin. It is no rate of a function of the pose, so that its value is 0 and the derivative of its gradient not symmetric. theory/joints Eq. (4.8)
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

/// The component of its gap that it acts along.
template <class S>
int slot_of(const BasicLoadData<S>& load) { return load.kind == LoadKind::kSpring || acts_in_body_axes(load) ? 0 : load.component; }

}  // namespace pintle
