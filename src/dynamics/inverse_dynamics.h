// Inverse dynamics: the joint forces that a given motion takes, the gaps that carry them, and what a joint force has to accelerate. theory/assembly sections 3 and 5.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "integrators/absolute/gap_projector.h"
#include "system/state.h"

namespace pintle {

/// The frequency above which modes are held, over the slowest of the joints by themselves: chains of joints and lever ratios
/// make modes a hundred times slower than that.
inline constexpr double kHeldAbove = 5e-4;
/// Rounds of friction and reactions at a start, at least: each gains the coefficient of friction times a lever ratio. With half of them the test
/// FrictionCircles takes more steps than it may.
inline constexpr int kFrictionRounds = 4;
/// And on while each changes by less than this of the one before, which oil films may not: a rope round a post gains a quarter in each. With half of it
/// the error stated for mechanisms/bollard.toml is 1e-5 of the peak instead of 5e-8; doubled, rounds that lead nowhere would not end.
inline constexpr double kFrictionContracts = 0.9;
inline constexpr int kMostJointsWithMasses = 300;  // up to which the forces that one gap's acceleration takes in all joints are asked for: the cost grows with the square
inline constexpr double kFits = 1e-9;  // of the largest force, or speed: gaps, or rates, that differ by no more fit together

/// What a force on a component of a gap has to accelerate, per joint and component [kg or kg*m^2]. Empty when no joint has
/// a stiffness.
template <class S>
struct BasicEffectiveMasses {
  VecsOf<S> closed;  // while all other gaps stay as they are; in mechanisms of hundreds of joints as `alone`
  VecsOf<S> alone;   // of the joint's own two bodies; 0 where they do not move the gap
};
using EffectiveMasses = BasicEffectiveMasses<Planar>;

/// Whether a law does not answer at all in some component in which it would hold its joint, as in its play.
template <class S>
bool is_in_play(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate);

/// Whether a joint that a start leaves where it is does not answer there: a rope that is slack, a roller above its floor.
template <class S>
bool is_apart(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate);

/// The same system with springs in place of the laws of these joints; none where there are none.
template <class S>
std::optional<BasicSystem<S>> with_springs(const BasicSystem<S>& system, const std::vector<int>& joints);

/// The joint forces that a given motion takes, and the gaps that carry them.
template <class S>
class BasicInverseDynamics {
 public:
  explicit BasicInverseDynamics(const BasicSystem<S>& system);

  /// The components (1, others 0) that `find` leaves to their laws: their forces are those of the gaps and rates that the
  /// bodies have, and their gaps accelerate as they may.
  void leave_to_laws(const VecsOf<S>& components);
  /// The same, and `move_onto_gaps` leaves these gaps as the other joints make them; of those in `slack`, which carry nothing, none is drawn taut.
  void release(const VecsOf<S>& components, const VecsOf<S>& slack);

  /// Accelerations and joint forces at state.q, state.v for which the gaps accelerate as state.gap_accel says; what no
  /// motion can close stays as state.force has it. False when there is no stiff joint or the equations are singular.
  bool find(BasicState<S>& state);
  /// From now on what rubs and has states, as bristles are, rubs as it does at rest with the rates of this start: over a short motion they do not bend, and what
  /// their dampers would give at the rates of that motion is no friction.
  void keep_states_of(const BasicState<S>& start);
  /// The accelerations alone.
  bool find_accelerations(BasicState<S>& state);
  /// The gaps at which the laws give state.force at state.gap_rate. False when one has been found not to carry its force.
  bool find_gaps(BasicState<S>& state) const;
  /// Moves q and v so that the joints have the gaps and rates of the state. Call after `find` near that state.
  void move_onto_gaps(BasicState<S>& state);
  /// From now on gaps and forces of laws that are not linear are improved by one step with the tangent, from those that the bodies have: what the laws are
  /// asked for lies near where the bodies are. theory/assembly Eq. (3.7).
  void linearize_nonlinear_laws();
  /// The same in those joints alone that others make redundant: found joint by joint, their gaps would not fit together.
  void linearize_redundant_laws(const BasicState<S>& state);
  bool is_linearized(std::size_t j) const { return linearized_[j]; }
  /// After `move_onto_gaps`: halves the way from `before` while a linearized law that resists at both ends of the way comes to the other side of a border of
  /// its own: a blade would snap there, and its law leads to no place where it holds its load.
  void limit_step_at_borders(const BasicState<S>& before, BasicState<S>& state);
  /// After `move_onto_gaps`: where gaps do not fit together, the forces become those of the gaps that the bodies have. Whether they did not fit.
  bool set_forces_from_bodies(BasicState<S>& state);
  BasicEffectiveMasses<S> effective_masses(const BasicState<S>& state);
  /// At this state from now on, for `forces_of_unit_gap_acceleration`. False when no joint is stiff or the equations are singular.
  bool prepare_unit_gap_accelerations(const BasicState<S>& state);
  /// The joint forces that make component c of the gap of joint j accelerate by 1, and no other gap.
  const VecsOf<S>& forces_of_unit_gap_acceleration(int j, int c);

 private:
  void find_kinematics(const BasicState<S>& state);
  bool is_nonlinear(int j) const;
  bool any_linearized() const;
  std::vector<std::pair<int, int>> slack_drawn_taut(const VecsOf<S>& held) const;
  void set_linearized_gaps_from_bodies(BasicState<S>& state) const;
  std::vector<int> apart(const BasicState<S>& state) const;
  typename S::Vec from_bodies(int j, const VecsOf<S>& x) const;
  double largest_held(const VecsOf<S>& gap) const;
  void push_by_laws(BasicState<S>& state);
  void push_by_friction(BasicState<S>& state);

  const BasicSystem<S>& system_;
  BasicGapProjector<S> projector_;
  std::vector<typename S::Motion> m_;
  std::vector<BasicJointKinematics<S>> r_;
  std::vector<int> rubbing_;      // joints with friction, stops, detents or pressure
  std::vector<bool> linearized_;  // joints whose gaps are found by one step with the tangent
  VecsOf<S> rest_rate_;           // with which friction that has states is found, where it is kept
  VecsOf<S> released_, slack_;      // 1 in components that move_onto_gaps does not hold, or not unless they tighten; empty: it holds what the joints do
  VecsOf<S> Q_, wanted_, by_law_, moved_, moves_, last_force_, no_load_, accelerated_, accelerating_;
};
using InverseDynamics = BasicInverseDynamics<Planar>;

}  // namespace pintle
