// Tells the user when a drive has brought the mechanism to a limit. theory/limits
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"
#include "run/record/force_recorder.h"

namespace pintle {

/// One note for each drive that a run has shown to push against a limit: when it was reached, where it is, which joints are in line, and
/// how hard the drive pushed. The time is found by integrating up to it again. `run` is finished; `recorder` is that of its last pass.
std::vector<std::string> limit_notes(const System& system, const State& start, const SimulateSettings& settings, const Trajectory& run, const ForceRecorder& recorder);

}  // namespace pintle
