// The door of this room: the state that a run starts from, and the complete system that goes with it.
#pragma once

#include "start/assembly.h"
#include "start/preload.h"
#include "start/settle_joints.h"

namespace pintle {

/// Assembles `model`, then, for start = "assembled", puts the joints on their slow motion so that no ringing is excited: theory/assembly
/// section 4. With `known_span`, the time over which the joints of a mechanism like this one are smooth [s], it is not looked for. Throws
/// AssemblyError when a loop cannot close.
Assembly start_of_run(const Model& model, double known_span = 0);

}  // namespace pintle
