// The second half of a start: positions, velocities and preload are there; the joints are put onto their slow motion, so that no ringing is
// excited. theory/assembly sections 4 and 5.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

/// A start and what is known of it.
template <class S>
struct BasicSettledStart {
  BasicState<S> state;             // t = 0
  std::vector<std::string> notes;  // what was assumed
  double span = 0;                 // over which the joints are smooth, where it was looked for [s]
  VecsOf<S> effective_mass;        // that a joint's force accelerates while other gaps stay closed, BasicEffectiveMasses::closed, where it was looked for
  double settled_over = 0;         // the joints' slow motion was found over this time [s]; 0: it was not, or not looked for
};

/// Puts the joints of start.state onto their slow motion, for a run of this duration. With `known_span`, the time over which the joints of
/// a mechanism like this one are smooth [s], it is not looked for.
template <class S>
void settle_joints(const BasicSystem<S>& system, double duration, double known_span, BasicSettledStart<S>& start);

/// Notes that the joints may ring from the start, unless they carry nothing or everything is at rest under loads that stay.
template <class S>
void note_not_settled(const BasicSystem<S>& system, const BasicState<S>& state, std::vector<std::string>& notes);

/// Whether bodies stand still, and joints carry what acts on them.
template <class S>
bool is_at_rest(const BasicSystem<S>& system, const BasicState<S>& state);

}  // namespace pintle
