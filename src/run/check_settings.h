// The settings of a run, as a program may give them.
#pragma once

#include "pintle/model.h"

namespace pintle {

inline constexpr double kMostRows = 1e7;  // of results: of 20 columns, 1.6 GB

/// Throws std::invalid_argument where a setting is out of range.
void check_settings(const SimulateSettings& settings);

}  // namespace pintle
