// Joint preload at the start: the forces that the motion needs, with the gaps, gap rates and gap accelerations that carry
// them, so that a run begins on the joints' slow motion and excites no ringing. theory/assembly section 3.
#pragma once

#include "integrators/gap_projector.h"
#include "system/state.h"

namespace pintle {

/// The gap at which a law gives `force` at `rate`; components without stiffness stay. theory/assembly Eq. (3.3).
void carry_force(const Law& law, const Planar::Vec& force, const Planar::Vec& rate, Planar::Vec& gap);

/// The joint forces that a given motion takes, and the gaps that carry them.
class ForcesOfMotion {
 public:
  explicit ForcesOfMotion(const System& system);

  /// Accelerations and joint forces at state.q, state.v for which the gaps accelerate as state.gap_accel says; what no
  /// motion can close stays as state.force has it. False when there is no stiff joint or the equations are singular.
  bool find(State& state);
  /// The gaps at which the laws give state.force at state.gap_rate.
  void carry(State& state) const;
  /// Moves q and v so that the joints have the gaps and rates of the state. Call after `find` near that state.
  void move_onto_gaps(State& state);

 private:
  Planar::Vec from_bodies(int j, const Vecs& x) const;

  const System& system_;
  GapProjector projector_;
  std::vector<Planar::Motion> m_;
  std::vector<Reading> r_;
  Vecs Q_, wanted_;
};

/// Accelerations that the joint forces really give at the state's gaps, and the gap accelerations that go with them.
void balance_start(const System& system, State& state);

/// Completes `state` (q, v given): accelerations, gaps and forces. With `preload` the positions and velocities are moved
/// by the (small) joint deflections; without it the joints start as the positions leave them.
void start_forces(const System& system, bool preload, State& state);

}  // namespace pintle
