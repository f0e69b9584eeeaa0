// Joint preload at the start: the forces that the motion needs, with the gaps, gap rates and gap accelerations that
// carry them, so that a run starts on the slow manifold and excites no ringing. theory/assembly section 3.
#pragma once

#include "pintle/model.h"
#include "system/state.h"

namespace pintle {

/// As a fraction of the mechanism's size, and in rad: a coordinate off by less counts as being at its stated value.
inline constexpr double kAsStated = 1e-9;

// Shared by starts of free bodies and starts over a tree.
inline constexpr int kPreloadPasses = 6;     // upper limit on alternating passes of forces and gaps
inline constexpr int kRedundantPasses = 30;  // upper limit while gaps do not yet fit together
inline constexpr int kCarefulPasses = 15;    // number of first passes that cross no border of a law
inline constexpr double kMostGrowth = 2;  // upper limit on the growth of the largest joint force in a start that has not converged

/// Whether joints start with the deflections that carry the forces that the motion needs.
inline bool is_preloaded(Start start) { return start == Start::kAssembled || start == Start::kSeated; }

/// Whether bodies that only touch in this joint are apart by more than the roundoff of a mechanism of this size [m].
template <class S>
bool is_open_contact(const BasicLaw<S>& law, const typename S::Vec& gap, double size) {
  return law.penetration(S::Vec::Zero()) == 0 && law.penetration(gap) < -kAsStated * size;
}

/// Whether a body has moved by more than the mechanism's size, or turned by more than half a turn.
template <class S>
bool moves_too_far(const BasicSystem<S>& system, const BasicState<S>& from, const BasicState<S>& to);

/// The rates of the laws' states, the joint forces and the accelerations of a state whose positions, gaps and law states are known.
void find_forces_and_accelerations(const System& system, State& state);

/// Accelerations caused by the actual joint forces at the state's gaps, and the corresponding gap accelerations.
template <class S>
void balance_start(const BasicSystem<S>& system, BasicState<S>& state);

/// Completes `state` (q, v given): accelerations, gaps and forces. With `preload` the positions and velocities are moved
/// by the (small) joint deflections; without it the gaps follow from the given positions.
template <class S>
void start_forces(const BasicSystem<S>& system, bool preload, BasicState<S>& state);

/// The mechanism's size, or its largest radius of gyration if that is larger, as for a rotor on its own axis [m].
double characteristic_length(const System& system, const Vecs& q);

}  // namespace pintle
