// Where the forces of a fleet are found inside a step, and what of the nodes' accelerations is the rate and the way there. theory/time
// section 5.
#pragma once

#include <array>

#include "integrators/radau_table.h"

namespace pintle {

struct FleetSamples {
  static constexpr int kStages = 3, kN = 5;  // both ends come on top
  std::array<double, kN + 2> x;              // of the step
  std::array<std::array<double, kStages + 1>, kN + 2> value, once, twice;  // weights of the nodes: in a curve and its integrals
  std::array<std::array<double, kN + 2>, kN + 2> to_powers;                // coefficient, sample

  explicit FleetSamples(const RadauTable& table);
};

}  // namespace pintle
