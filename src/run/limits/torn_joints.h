// Tells the user of joints that have given way by a part of the whole mechanism: no machine does. theory/limits section 3.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"
#include "system/state.h"

namespace pintle {

/// A note on the joint that its peak force has torn open farthest; empty: none is. `joints` are those of a finished run that began at `start`.
template <class S>
std::string note_on_torn_joint(const BasicSystem<S>& system, const BasicState<S>& start, const std::vector<LoadSummary>& joints);

}  // namespace pintle
