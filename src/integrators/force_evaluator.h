// States whose joint forces are what the laws make of positions and velocities: the plain equations of motion,
// theory/time Eq. (1.1), as methods see them that carry nothing but (q, v).
#pragma once

#include "system/state.h"

namespace pintle {

class ForceEvaluator {
 public:
  explicit ForceEvaluator(const System& system) : system_(system) {}

  /// Gaps, forces, accelerations and powers that belong to state.t, state.q, state.v.
  void complete(State& state);

 private:
  const System& system_;
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
};

/// A state with room for all bodies and joints of the system, all zero.
State zero_state(const System& system);

}  // namespace pintle
