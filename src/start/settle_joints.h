// The second half of a start: positions, velocities and preload are known; the joints are put onto their slow motion, so that no ringing is
// excited. theory/assembly sections 4 and 5.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

/// A start and what is known about it.
template <class S>
struct BasicSettledStart {
  BasicState<S> state;             // t = 0
  std::vector<std::string> notes;  // what was assumed
  double span = 0;                 // time over which the joints are smooth, where it was searched for [s]
  VecsOf<S> effective_mass;        // accelerated by a joint's force while other gaps stay closed, BasicEffectiveMasses::closed, where it was searched for
  double settled_over = 0;         // time over which the joints' slow motion was found [s]; 0: it was not found, or not searched for
};

/// Puts the joints of start.state onto their slow motion, for a run of this duration. `known_span`: the time over which the joints of a
/// mechanism like this one are smooth [s]; if given, it is not searched for.
template <class S>
void settle_joints(const BasicSystem<S>& system, double duration, double known_span, BasicSettledStart<S>& start);

/// Notes that the joints may ring from the start, unless they carry nothing or everything is at rest under constant loads.
template <class S>
void note_not_settled(const BasicSystem<S>& system, const BasicState<S>& state, std::vector<std::string>& notes);

/// Whether the bodies are at rest, with the joints balancing what acts on them.
template <class S>
bool is_at_rest(const BasicSystem<S>& system, const BasicState<S>& state);

}  // namespace pintle
