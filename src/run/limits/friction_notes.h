// Tells the user where a friction law that rises from zero with the slip never reaches its full friction, because the joint slips too slowly all the time.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// One note for each pin or slide that moves, but at every row slips at a small part of the `transition_speed` of its friction. Empty where the run did not record the rates.
std::vector<std::string> friction_notes(const Model& model, const Trajectory& run);

}  // namespace pintle
