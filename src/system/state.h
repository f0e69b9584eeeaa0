// One instant of a system: the quantities that an integrator advances.
#pragma once

#include "system/system.h"

namespace pintle {

/// Positions and velocities per body; gap, its rate and acceleration, and the force per joint. The gap is carried in
/// addition to the positions it belongs to: otherwise k times the rounding of a position would show in the force.
template <class S>
struct BasicState {
  double t = 0;
  PositionsOf<S> q;                 // bodies
  VecsOf<S> v, a;                   // their velocities and accelerations
  VecsOf<S> gap, gap_rate, gap_accel;   // joints
  VecsOf<S> force;                      // joints, on the second body, conjugate to the gap
  std::vector<double> law_state, law_rate;  // the laws' own states, in the order given by JointData::first_state
  std::vector<SlidingMode> sliding;  // motors that are held at one of their jumps
  double dissipated = 0, supplied = 0;        // since the start [J]
  double loss_power = 0, supply_power = 0;    // their rates [W]
};
using State = BasicState<Planar>;

/// The arguments of joint j's law in `state`.
template <class S>
BasicLawPoint<S> law_point(const BasicSystem<S>& system, int j, const BasicState<S>& state) {
  return {state.t, state.gap[j], state.gap_rate[j], state.law_state.data() + system.joints[j].first_state};
}
/// The forces that the laws of all joints give in `state`.
template <class S>
void find_joint_forces(const BasicSystem<S>& system, BasicState<S>& state);
/// The rates of the laws' own states that go with `state`.
template <class S>
void find_law_rates(const BasicSystem<S>& system, BasicState<S>& state);
/// Sets the laws' own states to those of joints that have long been at the gaps of `state`, moving at its rates.
template <class S>
void rest_laws(const BasicSystem<S>& system, BasicState<S>& state);

/// The gaps' accelerations that follow from those of the bodies: e'' = G a + bias.
template <class S>
void find_gap_accelerations(const BasicSystem<S>& system, const std::vector<BasicJointKinematics<S>>& r, BasicState<S>& state);
/// All accelerations that follow from the joint forces: M a = Q + G' f, then those of the gaps.
template <class S>
void find_accelerations(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const std::vector<BasicJointKinematics<S>>& r, BasicState<S>& state);

/// Energy stored by the laws of all joints, without servos [J].
template <class S>
double energy_of_joints(const BasicSystem<S>& system, const BasicState<S>& state);

/// The largest coordinate of any body, at least 1e-3: a measure of the rounding of positions, or of velocities [m or m/s].
template <class Vec>
double largest_coordinate(const std::vector<Vec>& x);
/// The largest angle of any body, counting turns in the plane; at least 1 rad.
template <class S>
double largest_angle(const PositionsOf<S>& q);
/// The stiffness of the stiffest joint against displacements, with one-sided laws treated as acting [N/m]; 0 if there is none.
template <class S>
double largest_stiffness(const BasicSystem<S>& system);
/// The largest force of any joint, without couples [N].
template <class Vec>
double largest_force(const std::vector<Vec>& force);
/// Whether everything that a step produces is finite.
template <class S>
bool is_finite(const BasicState<S>& state);

}  // namespace pintle
