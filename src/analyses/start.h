// The initial state of a run according to the model's `start` setting.
#pragma once

#include "analyses/assembly.h"

namespace pintle {

/// Assembles `model` (and settles `system`), then, for start = "assembled", puts the joints on their slow motion so that no
/// ringing is excited: theory/assembly section 4. With `known_span`, the time over which the joints of a mechanism like this one
/// are smooth [s], it is not looked for. Throws AssemblyError when a loop cannot close.
Assembly start_of_run(const Model& model, System& system, double known_span = 0);

}  // namespace pintle
