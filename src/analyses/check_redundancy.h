// Names of the redundant constraint components, grouped by dependency.
#pragma once

#include "analyses/check_rank.h"
#include "pintle/check.h"

namespace pintle {

/// Groups that do not depend on the basis in which dependencies are written: components belong together when the
/// projector onto the dependencies couples them; a group's degree is the projector's trace over it.
std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const DenseRank& rank);

/// The same from a factorisation; overlapping dependencies are one group.
std::vector<CheckRedundancy> redundancies(const System& system, const std::vector<ConstraintRow>& rows,
                                          const SparseRank& rank);

}  // namespace pintle
