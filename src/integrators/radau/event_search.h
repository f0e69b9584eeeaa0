// Locates the first event (kink or jump) on a step's polynomial. theory/time section 7.
#pragma once

#include <cstdint>

#include "integrators/radau/radau_table.h"

namespace pintle {

/// Shares of the step just before and just after an event; 2: there is none.
struct SwitchingEvent {
  double before = 2, after = 2;
};

/// Looks at the nodes and half-way between them for a branch other than `branch`, then halves the way to the first that is found.
template <class BranchAt>
SwitchingEvent first_event(const RadauTable& table, std::uint64_t branch, const BranchAt& branch_at) {
  constexpr int kHalvings = 46;
  double before = 0;
  for (int i = 0; i < 2 * table.n; ++i) {
    const double x = i % 2 == 0 ? 0.5 * (table.nodes[i / 2] + table.nodes[i / 2 + 1]) : table.nodes[i / 2 + 1];
    if (branch_at(x) == branch) {
      before = x;
      continue;
    }
    double after = x;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (before + after);
      (branch_at(middle) == branch ? before : after) = middle;
    }
    return {before, after};
  }
  return {};
}

}  // namespace pintle
