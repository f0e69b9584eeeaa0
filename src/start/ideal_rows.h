// The gap components constrained by the ideal equations: those of all ideal joints except the redundant ones.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mobility/mobility.h"
#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

struct IdealRows {
  System system;                        // with JointData::redundant
  std::vector<std::string> notes;       // what is redundant and what was left out
  std::vector<std::string> not_unique;  // joints whose reactions the ideal equations do not determine
};

/// `system`, built from `model`, with every joint that has a linear law, and every servo, marked as ideal; except laws that are flexible on purpose (LawInfo::yields).
[[nodiscard]] System make_ideal(const Model& model, System system);

/// Notes the groups of redundant constraints that have a joint for which `is_ideal` holds, and collects the joints whose reactions they leave undetermined. `what` are the
/// joints without compliance, in words.
void name_undetermined_reactions(const std::vector<CheckRedundancy>& groups, const std::function<bool(const std::string&)>& is_ideal, const char* what, std::vector<std::string>& notes,
                                 std::vector<std::string>& not_unique);

/// Finds which components are redundant at the assembled positions q. Reactions of omitted components are zero.
/// theory/ideal section 3.
[[nodiscard]] IdealRows choose_ideal_rows(System system, const Vecs& q);

}  // namespace pintle
