// The events of joints in a run, by kind.
#pragma once

#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// By joint and by what happened, ordered by first occurrence. For a run that was read back, the same as when it was written.
std::vector<EventKind> kinds_of_events(const Trajectory& run);

}  // namespace pintle
