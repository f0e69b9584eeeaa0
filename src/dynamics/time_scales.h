// Time scales of the joints' own dynamics compared with an interval: which gaps follow the slow manifold, which are
// overdamped, which oscillate with the motion. theory/assembly section 5.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
struct BasicTimeScales {
  /// 1 for components of either kind, 0 for others, one vector per joint. Overdamped: relaxation k/c is slow, but damping
  /// lets the rate decay at once. Resolved: the whole dynamics of the gap is part of the motion.
  VecsOf<S> overdamped, resolved;
  VecsOf<S> slow_rate;      // the slower of the gap's own two rates [1/s]; 0 without a stiffness
  VecsOf<S> effective_mass;  // BasicEffectiveMasses::closed, where it was measured
  double fastest = 0;  // the fastest rate of resolved components, each with its own two bodies alone [1/s]

  bool any_soft() const;
  bool any_resolved() const;
};
using TimeScales = BasicTimeScales<Planar>;

/// How a gap moves by itself: the roots of m s^2 + c s + k = 0. theory/assembly Eq. (5.2).
struct OwnRates {
  double slow = 0, fast = 0;  // their magnitudes [1/s]
  double decay = 0;           // the smaller of their real parts, without its sign [1/s]
};
OwnRates own_rates(double m, double c, double k);

/// No joint is soft.
template <class S>
BasicTimeScales<S> all_fast(const BasicSystem<S>& system);

/// Measures all gap components at `state`, with the masses that they move while other gaps stay closed.
template <class S>
BasicTimeScales<S> measure_time_scales(const BasicSystem<S>& system, const BasicState<S>& state, double span);

}  // namespace pintle
