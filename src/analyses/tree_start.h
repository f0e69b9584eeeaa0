// The state that a run over a joint tree starts from. theory/tree section 8.
#pragma once

#include <functional>

#include "analyses/assembly.h"

namespace pintle {

/// Finds the start with `free_bodies`, on a copy of `system` whose tree joints are very stiff laws, and takes it over into
/// the tree's coordinates: positions, rates, and gaps, forces and accelerations of the joints that stay laws. Settles `system`.
Assembly start_over_tree(const Model& model, System& system, const std::function<Assembly(const Model&, System&)>& free_bodies);

}  // namespace pintle
