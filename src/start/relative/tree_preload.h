// Preload and slow manifold at the start, over a joint tree: the counterpart of start_forces.h and slow_manifold.h for free
// bodies. theory/tree section 8.
#pragma once

#include "integrators/relative/tree_projector.h"

namespace pintle {

/// The forces that a given motion takes of the joints that stay laws, and the gaps that carry them.
class TreeInverseDynamics {
 public:
  TreeInverseDynamics(const System& system, const JointTree& tree) : at_(system, tree) {}

  /// w and forces at y, u for which the gaps accelerate as state.accel says. False when no joint is stiff. Eq. (6.3).
  bool find(TreeState& state);
  /// The gaps at which the laws give state.force at state.rate. False when one has been found not to carry its force.
  bool find_gaps(TreeState& state) const;
  /// Moves y and u so that the bodies have the gaps and rates of the state.
  void move_onto_gaps(TreeState& state);
  /// What the laws really give at the state's gaps, and the accelerations that go with it. Gaps that no stiffness holds, and
  /// those that no motion can close, are those of the bodies.
  void balance(TreeState& state);

  TreeInstant& instant() { return at_; }

 private:
  bool prepare(const TreeState& state);
  bool push_by_friction(TreeState& state);

  TreeInstant at_;
  TreeProjector projector_;
};

/// Completes `state` (t, y, u given): without `preload` the gaps are those of the bodies.
void start_tree_forces(TreeInverseDynamics& forces, bool preload, TreeState& state);

/// As move_onto_slow_manifold, over a tree.
double move_tree_onto_slow_manifold(const System& system, const JointTree& tree, double span, TreeState& state);

}  // namespace pintle
