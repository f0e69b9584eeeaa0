// Time scales of the joints' own dynamics compared with an interval: which gaps follow the slow manifold, which creep
// (overdamped), which oscillate with the motion. theory/assembly section 5.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

struct JointPaces {
  /// 1 for components of either kind, 0 for others, one vector per joint. Creeping: relaxation k/c is slow, but damping
  /// settles the rate at once. Lively: the whole dynamics of the gap is part of the motion.
  Vecs creeping, lively;
  Vecs slow_rate;      // the slower of the gap's own two rates [1/s]; 0 without a stiffness
  double fastest = 0;  // the fastest rate of lively components, with their own two bodies alone [1/s]

  bool any_soft() const;
  bool any_lively() const;
};

/// No joint is soft.
JointPaces all_fast(const System& system);

/// Measures the components of all gaps at `state`, with the bodies that they move while other gaps stay closed.
JointPaces measure_paces(const System& system, const State& state, double span);

}  // namespace pintle
