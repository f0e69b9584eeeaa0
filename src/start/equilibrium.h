// The start of a mechanism at rest: static equilibrium, including everything that is not smooth.
#pragma once

#include "start/assembly.h"

namespace pintle {

/// For start = "settled": the assembled mechanism comes to rest, with time fixed at t = 0 and the held coordinates in place. The run starts there,
/// with the states that the laws have then. Bodies creep through a thick fluid to where they rest: they fall into clearances and onto contacts and
/// stops without a bounce, and stick where friction holds them. theory/assembly section 7. Throws AssemblyError when a loop cannot close or the
/// mechanism does not come to rest. `smooth`: without friction on the way, so that nothing sticks.
Assembly start_in_equilibrium(const Model& model, bool smooth = false);

}  // namespace pintle
