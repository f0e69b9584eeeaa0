// Small motions about a position of rest: eigenvalues of the equations of motion with all their forces. theory/checks section 3.1.
#pragma once

#include "pintle/check.h"
#include "system/state.h"

namespace pintle {

/// About `start`, if nothing moves there or begins to.
CheckSmallMotions check_small_motions(const System& system, const State& start);

}  // namespace pintle
