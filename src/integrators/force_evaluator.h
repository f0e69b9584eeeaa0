// States whose joint forces follow by the laws from positions and velocities: the plain equations of motion,
// theory/time Eq. (1.1), for methods that carry only (q, v).
#pragma once

#include "system/state.h"

namespace pintle {

template <class S>
class BasicForceEvaluator {
 public:
  explicit BasicForceEvaluator(const BasicSystem<S>& system) : system_(system) {}

  /// Gaps, forces, accelerations and powers that belong to state.t, state.q, state.v.
  void complete(BasicState<S>& state);
  /// The values of the system's switching functions there; fills gaps and their rates.
  void find_roots(BasicState<S>& state, double* value);

 private:
  void find_gaps(BasicState<S>& state);

  const BasicSystem<S>& system_;
  std::vector<typename S::Motion> m_;
  std::vector<BasicJointKinematics<S>> r_;
};
using ForceEvaluator = BasicForceEvaluator<Planar>;

/// A state with room for all bodies and joints of the system, all zero.
template <class S>
BasicState<S> zero_state(const BasicSystem<S>& system);

}  // namespace pintle
