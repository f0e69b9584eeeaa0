// Inverse dynamics: the joint forces that a given motion needs, the gaps that carry them, and the masses that a joint force accelerates. theory/assembly sections 3
// and 5.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "integrators/absolute/gap_projector.h"
#include "system/state.h"

namespace pintle {

/// The frequency above which modes are held, as a fraction of the lowest frequency of any joint by itself: chains of joints
/// and lever ratios make modes a hundred times slower than that.
inline constexpr double kHeldAbove = 5e-4;
/// The same as a multiple of the rate at which the loads set the mechanism in motion: slower modes are part of its motion. Redundant joints with a misfit give such
/// modes to motions that would be free without it, and the misfit would drive them far. With half of it the relative coordinates of a parallelogram of three cranks, one
/// 0.5 mm out of place, start 5 mm away instead of 0.3 mm; twice it changes these starts by 0.02 mm.
inline constexpr double kHeldAboveMotion = 2;
/// Upper limit on that frequency, as a fraction of the lowest of any joint by itself: however soft a joint is, it carries the loads of its own bodies.
/// With twice it conveyor_belt takes half as many steps again; with a fifth the misfit of pinned plates moves them (test RelativeArm).
inline constexpr double kHeldAtMost = 0.01;
/// Lower limit on the rounds of friction and reactions at a start; each reduces the error by the coefficient of friction times a lever ratio.
/// With half as many the test FrictionCircles takes more steps than it may.
inline constexpr int kFrictionRounds = 4;
/// Rounds continue while each changes by less than this fraction of the previous change, which oil films may not do; for a rope round a post each round
/// gains a quarter. With half of it the error stated for mechanisms/bollard.toml is 1e-5 of the peak instead of 5e-8; with twice, rounds that do not
/// converge would not end.
inline constexpr double kFrictionContracts = 0.9;
inline constexpr int kMostJointsWithMasses = 300;  // up to here the forces in all joints due to one gap's acceleration are computed: the cost grows with the square
inline constexpr double kFits = 1e-9;  // as a fraction of the largest force, or speed: gaps, or rates, that differ by no more fit together

/// The effective mass that a force on a gap component accelerates, per joint and component [kg or kg*m^2]. Empty when no
/// joint has a stiffness.
template <class S>
struct BasicEffectiveMasses {
  VecsOf<S> closed;  // while all other gaps stay constant; in mechanisms of hundreds of joints the same as `alone`
  VecsOf<S> alone;   // of the joint's own two bodies alone; 0 where they do not move the gap
};
using EffectiveMasses = BasicEffectiveMasses<Planar>;

/// The frequency above which modes are held [rad/s], if `lowest` is the lowest of any joint by itself, and the loads would accelerate the mechanism
/// of this size [m] with `acceleration` [m/s^2] if nothing held it. theory/assembly section 3.
inline double held_above(double lowest, double acceleration, double size) {
  return std::clamp(kHeldAboveMotion * std::sqrt(acceleration / size), kHeldAbove * lowest, kHeldAtMost * lowest);
}
template <class S>
double held_above(const BasicSystem<S>& system, double lowest, const VecsOf<S>& loads, const std::vector<typename S::Coordinates>& q);

/// The lowest frequency of the modes that the stiffness of a joint gives to its two bodies, if nothing else holds them (only in components that are not 0 in `moved`, if
/// given) [rad/s]; infinity where it has no stiffness.
template <class S>
double lowest_own_frequency(const BasicSystem<S>& system, const BasicJointData<S>& joint, const BasicJointKinematics<S>& r, const typename S::Vec* moved = nullptr);

/// Whether a law gives no force at all in some component in which it would hold its joint, as within its play.
template <class S>
bool is_in_play(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate);

/// Whether a joint that a start leaves where it is gives no force there: a slack rope, a roller above its floor.
template <class S>
bool is_apart(const BasicLaw<S>& law, const typename S::Vec& gap, const typename S::Vec& rate);

/// The same system with springs in place of the laws of these joints; nullopt if `joints` is empty.
template <class S>
std::optional<BasicSystem<S>> with_springs(const BasicSystem<S>& system, const std::vector<int>& joints);

/// The joint forces that a given motion needs, and the gaps that carry them.
template <class S>
class BasicInverseDynamics {
 public:
  explicit BasicInverseDynamics(const BasicSystem<S>& system);

  /// Sets the components (1, others 0) that `find` leaves to their laws: their forces follow from the gaps and rates of
  /// the bodies, and their gap accelerations are free.
  void leave_to_laws(const VecsOf<S>& components);
  /// The same, and `move_onto_gaps` leaves these gaps to the other joints; none of those in `slack`, which carry nothing, is drawn taut.
  void release(const VecsOf<S>& components, const VecsOf<S>& slack);

  /// Finds accelerations and joint forces at state.q, state.v for which the gaps have the accelerations
  /// state.gap_accel; force combinations that no motion can change stay as in state.force. False if there is no stiff
  /// joint or the equations are singular.
  bool find(BasicState<S>& state);
  /// From now on friction with states, such as bristles, is that of bristles at rest with the rates of this start: over a short motion they do not bend, and
  /// their dampers' forces at the rates of that motion are not friction.
  void keep_states_of(const BasicState<S>& start);
  /// The accelerations alone.
  bool find_accelerations(BasicState<S>& state);
  /// Finds the gaps at which the laws give state.force at state.gap_rate. False if a law turns out not to carry its force.
  bool find_gaps(BasicState<S>& state) const;
  /// Moves q and v so that the joints have the gaps and rates of the state. Call after `find` near that state.
  void move_onto_gaps(BasicState<S>& state);
  /// From now on gaps and forces of nonlinear laws are improved by one Newton step from those of the bodies, which are near the required ones.
  /// theory/assembly Eq. (3.7).
  void linearize_nonlinear_laws();
  /// The same, but only in joints that others make redundant: found joint by joint, their gaps would not fit together.
  void linearize_redundant_laws(const BasicState<S>& state);
  bool is_linearized(std::size_t j) const { return linearized_[j]; }
  /// After `move_onto_gaps`: halves the step from `before` while a linearized law that resists at both ends of the step crosses one of its borders: a blade
  /// would snap through there, and its law would not lead to a position in which it holds its load.
  void limit_step_at_borders(const BasicState<S>& before, BasicState<S>& state);
  /// After `move_onto_gaps`: if gaps do not fit together, the forces become those of the bodies' gaps. Returns whether they did not fit.
  bool set_forces_from_bodies(BasicState<S>& state);
  BasicEffectiveMasses<S> effective_masses(const BasicState<S>& state);
  /// Sets the state for `forces_of_unit_gap_acceleration`. False when no joint is stiff or the equations are singular.
  bool prepare_unit_gap_accelerations(const BasicState<S>& state);
  /// The joint forces that give component c of the gap of joint j the acceleration 1, and all other gaps 0.
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
  std::vector<bool> linearized_;  // joints whose gaps are found by one Newton step
  VecsOf<S> rest_rate_;           // rates with which friction that has states is found, where they are kept
  VecsOf<S> released_, slack_;      // 1 in components that move_onto_gaps does not hold, or holds only if they tighten; empty: it holds the same as the joints
  VecsOf<S> Q_, wanted_, by_law_, moved_, moves_, last_force_, no_load_, accelerated_, accelerating_;
};
using InverseDynamics = BasicInverseDynamics<Planar>;

}  // namespace pintle
