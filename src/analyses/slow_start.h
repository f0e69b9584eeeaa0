// Joint preload at the start: the forces that the motion needs, with the gaps, gap rates and gap accelerations that carry
// them, so that a run begins on the joints' slow motion and excites no ringing. theory/assembly section 3.
#pragma once

#include "system/state.h"

namespace pintle {

/// Completes `state` (q, v given): accelerations, gaps and forces. With `preload` the positions and velocities are moved
/// by the (small) joint deflections; without it the joints start as the positions leave them.
void start_forces(const System& system, bool preload, State& state);

}  // namespace pintle
