// Preload and slow manifold at the start, over a joint tree: the counterpart of preload.h and slow_manifold.h for free
// bodies. theory/tree section 8.
#pragma once

#include "integrators/relative/tree_projector.h"

namespace pintle {

/// The forces that a given motion needs from the joints that stay laws, and the gaps that carry them.
class TreeInverseDynamics {
 public:
  TreeInverseDynamics(const System& system, const JointTree& tree) : at_(system, tree) {}

  /// Finds w and the forces at y, u for which the gaps have the accelerations state.accel. False if no joint is stiff. Eq.
  /// (6.3).
  bool find(TreeState& state);
  /// Finds the gaps at which the laws give state.force at state.rate. False if a law turns out not to carry its force.
  bool find_gaps(TreeState& state) const;
  /// Moves y and u so that the bodies have the gaps and rates of the state.
  void move_onto_gaps(TreeState& state);
  /// Finds the actual forces of the laws at the state's gaps, and the corresponding accelerations. Gaps without stiffness,
  /// and those that no motion can close, are taken from the bodies.
  void balance(TreeState& state);

  TreeInstant& instant() { return at_; }

 private:
  bool prepare(const TreeState& state);
  bool push_by_friction(TreeState& state);

  TreeInstant at_;
  TreeProjector projector_;
};

/// Completes `state` (t, y, u given). Without `preload` the gaps are those of the bodies.
void start_tree_forces(TreeInverseDynamics& forces, bool preload, TreeState& state);

/// As move_onto_slow_manifold, but over a tree.
double move_tree_onto_slow_manifold(const System& system, const JointTree& tree, double span, TreeState& state);

}  // namespace pintle
