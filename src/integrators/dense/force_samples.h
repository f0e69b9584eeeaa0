// The instants within a Radau IIA step at which joint forces are computed, and the weights that give acceleration,
// velocity and displacement there from the accelerations at the nodes. theory/time section 5.
#pragma once

#include <array>

#include "integrators/radau/radau_table.h"

namespace pintle {

struct ForceSamples {
  static constexpr int kN = 5, kAll = kN + 2;  // inside; with both ends
  using AtNodes = std::array<double, RadauTable::kMaxNodes>;

  std::array<double, kAll> x;                        // shares of the step: with both ends, the extrema of a Chebyshev polynomial on [0, 1]
  std::array<AtNodes, kAll> value, once, twice;      // weights of the nodes for a curve and its integrals from the start
  std::array<std::array<double, kAll>, kAll> to_powers;  // coefficient, sample

  static const ForceSamples& of(const RadauTable& table);

 private:
  explicit ForceSamples(const RadauTable& table);
};

}  // namespace pintle
