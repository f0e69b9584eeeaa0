// The stated accuracy of a run's joint forces.
#pragma once

#include "pintle/trajectory.h"

namespace pintle {

/// Whether a second integration has said how good the joint forces are. A run that stopped before has no numbers for estimates.
bool has_force_estimates(const Trajectory& run);

/// Whether the peak comes after the time up to which a chaotic motion's force is promised: its error is not that of the rows before.
bool peaks_behind_horizon(const LoadSummary& joint, const Trajectory& run);

/// The joint with the largest peak force; nullptr: the run has no joints.
const LoadSummary* largest_joint(const Trajectory& run);

/// Whether the estimate exceeds the tolerance, which is of forces; where it is not a number, it does.
bool misses_tolerance(const LoadSummary& joint, const Trajectory& run);

}  // namespace pintle
