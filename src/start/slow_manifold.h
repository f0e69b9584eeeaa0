// The slow manifold from a given start: the gaps required by the motion over a short interval, free of ringing, by
// fixed-point iteration on polynomials. theory/assembly Eqs. (4.1)-(4.4), and section 5 for soft joints.
#pragma once

#include "dynamics/time_scales.h"
#include "system/state.h"

namespace pintle {

/// A stretch of time, at most `longest`, that is short against the motion with closed joints: a quarter of one over which a
/// polynomial follows its forces. No stiffness enters, so that it says the same whatever the joints are. 0 when there is none.
template <class S>
double span_of_motion(const BasicSystem<S>& system, const BasicState<S>& state, double longest);

template <class S>
struct BasicSoftStart {
  bool placed = false;    // false: the state is as it was
  double change = 1e300;  // relative, of the gaps in the last sweep
  VecsOf<S> share;             // per component: how far it goes with the motion, 1 entirely (fast ones do), 0 not at all
};
using SoftStart = BasicSoftStart<Planar>;

/// Moves soft joints to where the motion would take them if it were slow against them: gaps that carry the forces, with
/// the rates that go with them as far as that makes sense. `span` is only the time over which derivatives are found.
template <class S>
BasicSoftStart<S> place_soft_joints(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state);

/// Given positions, velocities and forces of `start_forces`, finds gap rates and accelerations of the fast joints at the
/// start by following the motion over `span` seconds, and moves the state onto them. Soft joints follow their own dynamics
/// from where the state has them. Returns the last relative change of the gaps; a large number, and the state as it was,
/// when the iteration does not shrink it (a kink, a long span).
template <class S>
double move_onto_slow_manifold(const BasicSystem<S>& system, const BasicTimeScales<S>& time_scales, double span, BasicState<S>& state);

}  // namespace pintle
