// The bearings of a run for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// Duty of each pin, life and static safety, pressure and sliding, and what is missing for more; each begins with an empty line. Nothing
/// where there are no bearings. Heads of tables stand between `bold` and `plain`.
std::string bearing_text(const std::vector<BearingSummary>& bearings, const std::string& bold = "", const std::string& plain = "");

/// "joint B: state ...", once for each thing that is missing and each remark.
std::vector<std::string> bearing_notes(const std::vector<BearingSummary>& bearings);

/// The list that stands under "bearings" in summary.json, in an object of its own.
std::string bearing_json(const std::vector<BearingSummary>& bearings);

}  // namespace pintle
