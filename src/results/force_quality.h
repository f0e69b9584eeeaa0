// The stated accuracy of a run's joint forces.
#pragma once

#include "pintle/trajectory.h"

namespace pintle {

/// Whether a second integration has estimated the errors of the joint forces. A run that stopped before that has no estimates.
bool has_force_estimates(const Trajectory& run);

/// Whether the peak comes after the time up to which the forces of a chaotic motion are promised: its error then differs from that of the rows before.
bool peaks_behind_horizon(const LoadSummary& joint, const Trajectory& run);

/// Whether its relative error is that of its couple, which is larger than that of its force.
bool couple_decides(const LoadSummary& joint);

/// The joint with the largest peak force; nullptr: the run has no joints.
const LoadSummary* largest_joint(const Trajectory& run);

/// Whether the estimate exceeds the tolerance, where this applies to forces; an estimate that is NaN does.
bool misses_tolerance(const LoadSummary& joint, const Trajectory& run);

}  // namespace pintle
