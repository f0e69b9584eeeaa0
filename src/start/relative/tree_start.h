// The start of a run over a joint tree is that of free bodies with very stiff joints in the tree, in the tree's coordinates. theory/tree section 8.
#pragma once

#include "system/joint_tree.h"
#include "system/state.h"

namespace pintle {

/// The same system with stiff laws for the tree's joints, whose deflection is negligible.
System with_stiff_tree(System system, const JointTree& tree);

/// Replaces a start of free bodies by that in the coordinates of the joint tree of `system`. If it is `preloaded`, the laws keep its gaps and what goes with
/// them; otherwise they have the gaps of the bodies as the tree places them.
void convert_to_tree(const System& system, bool preloaded, State& state);

}  // namespace pintle
