// The gap components constrained by the ideal equations: those of all ideal joints except the redundant ones.
#pragma once

#include <string>
#include <vector>

#include "system/system.h"

namespace pintle {

struct IdealRows {
  System system;                        // with JointData::redundant
  std::vector<std::string> notes;       // what is redundant and what was left out
  std::vector<std::string> not_unique;  // joints whose reactions the ideal equations do not determine
};

/// `system` with every joint that has a linear law, and every servo, marked as ideal.
[[nodiscard]] System make_ideal(System system);

/// Finds which components are redundant at the assembled positions q. Reactions of omitted components are zero.
/// theory/ideal section 3.
[[nodiscard]] IdealRows choose_ideal_rows(System system, const Vecs& q);

}  // namespace pintle
