// The interior of an implicit step.
#pragma once

#include <array>
#include <vector>

#include "integrators/radau/radau_table.h"
#include "system/system.h"

namespace pintle {

/// Accelerations, joint forces, states of laws and powers at the nodes {0, c_1 .. c_n} of the last step.
template <class S>
struct BasicStepNodes {
  const RadauTable* table = nullptr;
  std::vector<VecsOf<S>> a, gap_accel, force;
  std::vector<std::vector<double>> law_state, law_rate;  // of the laws' own states
  std::vector<std::array<double, 2>> power;  // supplied, lost [W]
  /// In curved spaces: the rates of the bodies' increments at the nodes, and by how much their integral misses the step's end.
  std::vector<VecsOf<S>> increment_rate{};
  VecsOf<S> increment_bend{};
};
using StepNodes = BasicStepNodes<Planar>;

}  // namespace pintle
