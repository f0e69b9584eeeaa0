// Tells the user where the pressure in a cylinder has fallen below vacuum, as that of a flow law does when the load overruns the pump.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// One note for each such chamber: when its pressure is lowest, and how low. Empty where the run did not record the pressures.
std::vector<std::string> vacuum_notes(const Model& model, const Trajectory& run);

}  // namespace pintle
