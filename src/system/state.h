// One instant of a system: what an integrator advances.
#pragma once

#include "system/system.h"

namespace pintle {

/// Positions and velocities per body; gap, its rate and acceleration, and the force per joint. The gap is carried beside
/// the positions it belongs to: k times the rounding of a position would show in the force otherwise.
struct State {
  double t = 0;
  Vecs q, v, a;                    // bodies [m, m, rad] and derivatives
  Vecs gap, gap_rate, gap_accel;   // joints
  Vecs force;                      // joints, on the second body, conjugate to the gap
  std::vector<double> law_state, law_rate;  // of the laws' own states, as JointData::first_state counts them
  std::vector<SlidingMode> sliding;  // motors that stand at a jump of theirs
  double dissipated = 0, supplied = 0;        // since the start [J]
  double loss_power = 0, supply_power = 0;    // their rates [W]
};

/// Where the law of joint j is asked in `state`.
inline LawPoint law_point(const System& system, int j, const State& state) {
  return {state.t, state.gap[j], state.gap_rate[j], state.law_state.data() + system.joints[j].first_state};
}
/// The rates of the laws' own states that go with `state`.
void find_law_rates(const System& system, State& state);
/// The laws' own states as those of joints that have long been at the gaps of `state`, moving at its rates.
void rest_laws(const System& system, State& state);

/// The gaps' accelerations that go with those of the bodies: e'' = G a + bias.
void find_gap_accelerations(const System& system, const std::vector<JointKinematics>& r, State& state);
/// All accelerations that go with the joint forces: M a = Q + G' f, then those of the gaps.
void find_accelerations(const System& system, const std::vector<Planar::Motion>& m, const std::vector<JointKinematics>& r, State& state);

/// The largest coordinate of any body, at least 1e-3: what the rounding of positions, or of velocities, goes with [m or m/s].
double largest_coordinate(const Vecs& x);
/// The largest force of any joint; couples are not in it [N].
double largest_force(const Vecs& force);
/// Whether everything that a step gives is a number.
bool is_finite(const State& state);

}  // namespace pintle
