// A run of a mechanism that stands in no model file, in the plane or in space: what `simulate` makes of a model, from C++.
#pragma once

#include "pintle/simulate.h"
#include "run/record/force_table.h"

namespace pintle {

template <class S>
struct BasicSystemRun {
  Trajectory result;        ///< loads of the joints with their stated errors, energy account, counters, outcome, notes; no columns
  BasicForceTable<S> rows;  ///< at the output times: places and velocities of the bodies, loads of the joints
};
using SystemRun = BasicSystemRun<Planar>;

/// Runs `system` from `start` as `settings` say; their start and record are not looked at. `start` is complete, at t = 0: places and velocities are
/// the caller's, `start_forces` (start/start.h) finds what goes with them, `settle_joints` puts joints onto their
/// slow motion, so that none rings. In space the stated errors are of the magnitudes of force and couple of every joint, as in the plane.
/// Throws std::invalid_argument for a start or settings that cannot be; a numerical failure or an interruption is a value in the outcome.
template <class S>
BasicSystemRun<S> run_system(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const Observer& observer = {});

}  // namespace pintle
