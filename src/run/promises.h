// What a run promises of a chaotic motion: each joint's force up to its horizon, statistics after it. theory/time section 6.1.
#pragma once

#include "pintle/trajectory.h"
#include "run/error_growth.h"
#include "run/pass_difference.h"

namespace pintle {

/// Fills in horizons, errors up to them, statistics after them, growth and message. `out` has its summaries; `share` is that of Eq. (6.2),
/// `within` what it times the difference may be [-].
void promise_until_horizons(const System& system, const ForceTable& coarse, const ForceTable& fine, double share, double within, const ErrorGrowth& growth, Trajectory& out);

}  // namespace pintle
