// Joint preload at the start: the forces that the motion needs, with the gaps, gap rates and gap accelerations that
// carry them, so that a run starts on the slow manifold and excites no ringing. theory/assembly section 3.
#pragma once

#include "integrators/absolute/gap_projector.h"
#include "system/state.h"

namespace pintle {

/// The frequency above which modes are held, over the slowest of the joints by themselves: chains of joints and lever ratios
/// make modes a hundred times slower than that.
inline constexpr double kHeldAbove = 5e-4;

/// The gap at which a law gives `force` at `rate`; components without stiffness stay. theory/assembly Eq. (3.3).
void gap_at_force(const Law& law, const Planar::Vec& force, const Planar::Vec& rate, Planar::Vec& gap);

/// What a force on a component of a gap has to accelerate, per joint and component [kg or kg*m^2]. Empty when no joint has
/// a stiffness.
struct EffectiveMasses {
  Vecs closed;  // while all other gaps stay as they are; in mechanisms of hundreds of joints as `alone`
  Vecs alone;   // of the joint's own two bodies; 0 where they do not move the gap
};

/// The joint forces that a given motion takes, and the gaps that carry them.
class InverseDynamics {
 public:
  explicit InverseDynamics(const System& system);

  /// The components (1, others 0) that `find` leaves to their laws: their forces are those of the gaps and rates that the
  /// bodies have, and their gaps accelerate as they may.
  void leave_to_laws(const Vecs& components);

  /// Accelerations and joint forces at state.q, state.v for which the gaps accelerate as state.gap_accel says; what no
  /// motion can close stays as state.force has it. False when there is no stiff joint or the equations are singular.
  bool find(State& state);
  /// The accelerations alone.
  bool find_accelerations(State& state);
  /// The gaps at which the laws give state.force at state.gap_rate.
  void find_gaps(State& state) const;
  /// Moves q and v so that the joints have the gaps and rates of the state. Call after `find` near that state.
  void move_onto_gaps(State& state);
  EffectiveMasses effective_masses(const State& state);

 private:
  Planar::Vec from_bodies(int j, const Vecs& x) const;
  double largest_held(const Vecs& gap) const;
  void push_by_laws(State& state);
  void push_by_friction(State& state);

  const System& system_;
  GapProjector projector_;
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
  std::vector<int> rubbing_;  // joints with friction
  Vecs Q_, wanted_, by_law_, moved_;
};

/// Accelerations that the joint forces really give at the state's gaps, and the gap accelerations that go with them.
void balance_start(const System& system, State& state);

/// Completes `state` (q, v given): accelerations, gaps and forces. With `preload` the positions and velocities are moved
/// by the (small) joint deflections; without it the joints start as the positions leave them.
void start_forces(const System& system, bool preload, State& state);

}  // namespace pintle
