// Time scales of the joints' own dynamics compared with an interval: which gaps follow the slow manifold, which are overdamped
// (overdamped), which oscillate with the motion. theory/assembly section 5.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

struct TimeScales {
  /// 1 for components of either kind, 0 for others, one vector per joint. Overdamped: relaxation k/c is slow, but damping
  /// settles the rate at once. Resolved: the whole dynamics of the gap is part of the motion.
  Vecs overdamped, resolved;
  Vecs slow_rate;      // the slower of the gap's own two rates [1/s]; 0 without a stiffness
  double fastest = 0;  // the fastest rate of resolved components, with their own two bodies alone [1/s]

  bool any_soft() const;
  bool any_resolved() const;
};

/// No joint is soft.
TimeScales all_fast(const System& system);

/// Measures the components of all gaps at `state`, with the bodies that they move while other gaps stay closed.
TimeScales measure_time_scales(const System& system, const State& state, double span);

}  // namespace pintle
