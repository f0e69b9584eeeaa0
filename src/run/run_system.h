// A run, from C++, of a mechanism without a model file, in the plane or in space: the counterpart of `simulate` for models.
#pragma once

#include "pintle/simulate.h"
#include "run/record/force_table.h"

namespace pintle {

template <class S>
struct BasicSystemRun {
  Trajectory result;        ///< loads of the joints with their stated errors, energy account, counters, outcome, notes; no columns
  BasicForceTable<S> rows;  ///< at the output times: positions and velocities of the bodies, loads of the joints
};
using SystemRun = BasicSystemRun<Planar>;

/// Runs `system` from `start` with `settings`, whose start and record are ignored. `start` must be complete, at t = 0: the caller supplies positions
/// and velocities, `start_forces` (start/start.h) finds the rest, and `settle_joints` puts the joints on their
/// slow motion, so that none rings. In space the stated errors are for the magnitudes of force and couple of every joint, as in the plane.
/// Throws std::invalid_argument for an impossible start or impossible settings; a numerical failure or an interruption is reported in the outcome.
template <class S>
BasicSystemRun<S> run_system(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const Observer& observer = {});

}  // namespace pintle
