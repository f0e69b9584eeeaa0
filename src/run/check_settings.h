// The settings of a run, as a program may give them.
#pragma once

#include "pintle/model.h"

namespace pintle {

/// Throws std::invalid_argument where a setting is out of range.
void check_settings(const SimulateSettings& settings);

}  // namespace pintle
