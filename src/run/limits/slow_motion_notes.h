// Tells the user where a joint moves so slowly that a speed which makes its law smooth at rest decides its force.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// Notes on joints that move, but at every row slip at a small part of the `transition_speed` of their friction, and on those whose every touch is slower than the floor of
/// the approach speed. Where the run did not record rates or events, there are none.
std::vector<std::string> slow_motion_notes(const Model& model, const Trajectory& run);

}  // namespace pintle
