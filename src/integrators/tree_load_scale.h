// The loads that relative errors refer to, over a joint tree: as with free bodies, so that both make steps alike.
#pragma once

#include "integrators/stage_solver.h"
#include "system/state.h"

namespace pintle {

/// Raises `scale` to what acts on each body of `state`, where G is read at `m` and Q are the external forces. theory/time
/// section 3.5.
void grow_load_scale(const System& system, const std::vector<Planar::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale);

}  // namespace pintle
