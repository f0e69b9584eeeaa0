// What a run promises of a chaotic motion: each joint's force up to its horizon, statistics after it. theory/time section 6.1.
#pragma once

#include "pintle/trajectory.h"
#include "run/errors/error_growth.h"
#include "run/errors/stated_error.h"
#include "run/record/force_recorder.h"

namespace pintle {

/// Fills in horizons, errors up to them, statistics after them, growth and message. `out` already has its summaries; `share` is that of Eq. (6.2),
/// `within` the upper limit on `share` times the difference [-], and `least` the lower limits on errors, with the smallest
/// tolerance of any pass.
template <class S>
void promise_until_horizons(const BasicSystem<S>& system, const BasicForceRecorder<S>& coarse, const BasicForceRecorder<S>& fine, double share, double within, const BasicLeastError<S>& least, const ErrorGrowth& growth, Trajectory& out);

}  // namespace pintle
