// What joints have gone through in a run, by kind of event.
#pragma once

#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// By joint and by what happened, in the order of the first time. Of a run that was read back, as it was written.
std::vector<EventKind> kinds_of_events(const Trajectory& run);

}  // namespace pintle
