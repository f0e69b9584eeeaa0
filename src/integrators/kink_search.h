// Locates the first event (kink or jump) on a step's polynomial. theory/time section 7.
#pragma once

#include <cstdint>

#include "integrators/radau_table.h"

namespace pintle {

/// Shares of the step just before and just after a kink; 2: there is none.
struct Kink {
  double before = 2, after = 2;
};

/// Looks at the nodes and half-way between them for a side other than `side`, then halves the way to the first that is found.
template <class SideAt>
Kink first_kink(const RadauTable& table, std::uint64_t side, const SideAt& side_at) {
  constexpr int kHalvings = 46;
  double before = 0;
  for (int i = 0; i < 2 * table.n; ++i) {
    const double x = i % 2 == 0 ? 0.5 * (table.nodes[i / 2] + table.nodes[i / 2 + 1]) : table.nodes[i / 2 + 1];
    if (side_at(x) == side) {
      before = x;
      continue;
    }
    double after = x;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (before + after);
      (side_at(middle) == side ? before : after) = middle;
    }
    return {before, after};
  }
  return {};
}

}  // namespace pintle
