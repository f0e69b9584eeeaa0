// Joint preload at the start: the forces that the motion needs, with the gaps, gap rates and gap accelerations that
// carry them, so that a run starts on the slow manifold and excites no ringing. theory/assembly section 3.
#pragma once

#include "pintle/model.h"
#include "system/state.h"

namespace pintle {

/// Of the mechanism's size, and in rad: what is off by less is where it was stated to be.
inline constexpr double kAsStated = 1e-9;

// Of free bodies, and over a tree.
inline constexpr int kPreloadPasses = 6;     // of forces and gaps in turns, at most
inline constexpr int kRedundantPasses = 30;  // where gaps do not fit together yet
inline constexpr int kCarefulPasses = 15;    // of these that cross no border of a law, at first
inline constexpr double kMostGrowth = 2;  // of the largest joint force, by an attempt at a start that has not converged

/// Whether joints start with the deflections that carry what the motion needs.
inline bool is_preloaded(Start start) { return start == Start::kAssembled || start == Start::kSeated; }

/// Whether bodies that only touch in this joint stand apart, by more than the rounding of a mechanism of this size [m].
template <class S>
bool is_open_contact(const BasicLaw<S>& law, const typename S::Vec& gap, double size) {
  return law.penetration(S::Vec::Zero()) == 0 && law.penetration(gap) < -kAsStated * size;
}

/// Accelerations that the joint forces really give at the state's gaps, and the gap accelerations that go with them.
template <class S>
void balance_start(const BasicSystem<S>& system, BasicState<S>& state);

/// Completes `state` (q, v given): accelerations, gaps and forces. With `preload` the positions and velocities are moved
/// by the (small) joint deflections; without it the joints start as the positions leave them.
template <class S>
void start_forces(const BasicSystem<S>& system, bool preload, BasicState<S>& state);

/// The mechanism's size, or its largest radius of gyration where that is more, as of a rotor on its own axis [m].
double characteristic_length(const System& system, const Vecs& q);

}  // namespace pintle
