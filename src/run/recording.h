// Which bodies and joints a run records, and how often. Forces of all joints are compared and summarised regardless.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

struct Recording {
  std::vector<bool> body, joint;  // whether its columns are kept; joints of the system
  std::string note;               // what was left out by default; empty: nothing
};
Recording choose_recording(const Model& model, const System& system);

/// The time between two rows: as stated, otherwise a fraction of the duration that keeps the tables of forces bounded [s].
double output_step_of(const SimulateSettings& settings, std::size_t n_joints);

}  // namespace pintle
