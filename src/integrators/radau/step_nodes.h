// What an implicit step knows of its inside.
#pragma once

#include <array>
#include <vector>

#include "integrators/radau/radau_table.h"
#include "system/system.h"

namespace pintle {

/// Accelerations, joint forces, states of laws and powers at the nodes {0, c_1 .. c_n} of the last step.
struct StepNodes {
  const RadauTable* table = nullptr;
  std::vector<Vecs> a, gap_accel, force;
  std::vector<std::vector<double>> law_state, law_rate;  // of the laws' own states
  std::vector<std::array<double, 2>> power;  // supplied, lost [W]
};

}  // namespace pintle
