// Life of rolling bearings (ISO 281, ISO 76), and pressure and sliding in plain ones, from the forces and angles of a run.
#pragma once

#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// Which revolute joints to summarize: those whose model states a bearing or an oil film and those whose law knows its size; or every one, as if the others
/// stated an empty bearing.
enum class BearingsOf { kStated, kEveryPin };

/// In the order of the model. Only the bearings are read from `model`; all other values are those of the run. theory/bearing_life
std::vector<BearingSummary> bearing_summaries(const Model& model, const Trajectory& run, BearingsOf which = BearingsOf::kStated);

/// Exponent of load in the life formula: 3 for balls, 10/3 for rollers; NaN where the type is not stated [-].
double life_exponent(const Bearing& bearing);

}  // namespace pintle
