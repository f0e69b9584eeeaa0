// The coordinates of a joint tree that go with given gaps of the joints that stay laws: the counterpart of balance_start and move_onto_gaps for
// free bodies. theory/tree section 8.
#pragma once

#include "integrators/relative/tree_projector.h"

namespace pintle {

class TreeGaps {
 public:
  TreeGaps(const System& system, const JointTree& tree) : at_(system, tree) {}

  /// Sets the gaps, rates and states of the laws to those that the bodies have at t, y and u.
  void set_gaps_from_bodies(TreeState& state);
  /// Moves y and u so that the bodies have the gaps and rates of the state, except what no motion can close.
  void move_onto_gaps(TreeState& state);
  /// Finds the actual forces of the laws at the state's gaps, and the corresponding accelerations. Gaps without stiffness,
  /// and those that no motion can close, are taken from the bodies.
  void balance(TreeState& state);

  TreeInstant& instant() { return at_; }

 private:
  TreeInstant at_;
  TreeProjector projector_;
};

}  // namespace pintle
