// The start of a mechanism that is at rest: static equilibrium, with all that is not smooth in it.
#pragma once

#include "start/assembly.h"

namespace pintle {

/// For start = "settled": the assembled mechanism comes to rest, with time standing still at t = 0 and what the model holds where it is, and the
/// run starts there, with the states that the laws have then. Bodies creep through a thick fluid to where they rest: they fall into the play of
/// clearances, onto contacts and stops, without a bounce, and stick where friction holds them. theory/assembly section 7. Throws AssemblyError where a
/// loop cannot close, and where the mechanism comes to no rest. `smooth`: without friction on the way, which sticks nowhere then.
Assembly start_in_equilibrium(const Model& model, bool smooth = false);

}  // namespace pintle
