// The state that a run over a joint tree starts from. theory/tree section 8.
#pragma once

#include "start/assembly.h"

namespace pintle {

/// Assembles a copy of `system`, which build_system has made from `model`, with very stiff laws for the tree's joints. Converts
/// positions and rates into the tree's coordinates and, for start = "assembled", puts the joints that stay laws on their slow motion.
/// The returned assembly has the joints' own laws again.
Assembly start_over_tree(const Model& model, const System& system);

}  // namespace pintle
