// The state that a run starts from, as the model's `start` setting asks.
#pragma once

#include "analyses/assembly.h"

namespace pintle {

/// Assembles `model` (and settles `system`), then, for start = "assembled", puts the joints on their slow motion so that no
/// ringing is excited: theory/assembly section 4. Throws AssemblyError when a loop cannot close.
Assembly start_of_run(const Model& model, System& system);

}  // namespace pintle
