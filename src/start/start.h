// Entry point of this directory: the state that a run starts from, with its complete system.
#pragma once

#include "start/assembly.h"
#include "start/preload.h"
#include "start/settle_joints.h"

namespace pintle {

/// Assembles `model`, then, for start = "assembled", puts the joints on their slow motion so that no ringing is excited: theory/assembly
/// section 4. `known_span`: the time over which the joints of a mechanism like this one are smooth [s]; if given, it is not searched for.
/// Throws AssemblyError when a loop cannot close.
Assembly start_of_run(const Model& model, double known_span = 0);

}  // namespace pintle
