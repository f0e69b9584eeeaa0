// Names of the redundant constraint components, grouped by dependency.
#pragma once

#include "mobility/rank.h"
#include "pintle/check.h"

namespace pintle {

/// The groups do not depend on the basis chosen for the dependencies: components belong together if the
/// projector onto the dependencies couples them; a group's degree is the projector's trace over it.
std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const DenseRank& rank);

/// The same from a factorisation; overlapping dependencies form one group.
std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const SparseRank& rank);

}  // namespace pintle
