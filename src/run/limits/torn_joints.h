// Tells the user of joints that have deflected by a considerable part of the mechanism's size, as no machine does. theory/limits section 3.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

/// A note on the joint that its peak force has torn open farthest; empty if there is none. `joints` are those of a finished run that began at `start`.
template <class S>
std::string note_on_torn_joint(const BasicSystem<S>& system, const BasicState<S>& start, const std::vector<LoadSummary>& joints);

}  // namespace pintle
