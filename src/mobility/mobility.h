// Mobility by Gruebler's count and by rank, and the redundant constraints. theory/checks.
#pragma once

#include <vector>

#include "pintle/check.h"
#include "system/system.h"

namespace pintle {

struct MobilityCheck {
  CheckMobility counts;
  std::vector<CheckRedundancy> redundancies;
  Vecs regular;  // an assembled position of the highest rank found
};

/// `q`: assembled positions, with the joints strained as little as possible.
MobilityCheck check_mobility(const System& system, const Vecs& q);

}  // namespace pintle
