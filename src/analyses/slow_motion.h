// The joints' slow motion from a given start: the gaps that the motion itself demands over a short stretch of time, free of
// ringing, by fixed-point iteration on polynomials. theory/assembly Eqs. (4.1)-(4.4).
#pragma once

#include "system/state.h"

namespace pintle {

/// Given positions, velocities and the forces of `start_forces`, finds gap rates and accelerations at the start by
/// following the motion over `span` seconds, and moves the state onto them. Returns the last relative change of the gaps;
/// a large number, and the state as it was, when the iteration does not shrink it (a soft joint, a kink, a long span).
double settle_on_slow_motion(const System& system, double span, State& state);

}  // namespace pintle
