// Joints in the stage solver whose law is more than springs and dampers: the law's own states at the stages, eliminated joint by joint.
// Included where it is compiled for registers of several widths. theory/time Eqs. (3.16)-(3.18).
#pragma once

#include <algorithm>

#include "integrators/absolute/lane_stage_solver.h"

namespace pintle {

// The states of a law at the stages, its force, and what is missing in its states' equations.
template <int N>
void LaneStageSolver<N>::place_general(const State& begin, Joint& joint, const L* gap, const L* rate, L* force) {
  const JointData& data = system_.joints[joint.index];
  General& general = general_[joint.general];
  for (std::size_t z = 0; z < general.state.size(); ++z) general.state[z] = L::all(begin.law_state[data.first_state + z]) + step_.A * general.rate[z];
  LawInput<L> in;
  in.t = L::all(begin.t) + step_.c;
  std::copy_n(gap, 3, in.gap);
  std::copy_n(rate, 3, in.rate);
  in.state = general.state.data();
  LawOutput<L> out;
  data.law.evaluate(in, out);
  std::copy_n(out.force, 3, force);
  for (std::size_t z = 0; z < general.state.size(); ++z) general.residual[z] = general.rate[z] - out.state_rate[z];
}

// The forces that answer what is missing in a gap's equation and in those of the law's states. Eq. (3.16).
template <int N>
void LaneStageSolver<N>::answer_states(General& general, const X* missing, X* f) const {
  weigh(false, general.over_mu2, missing, f);
  std::copy_n(missing, 3, general.missing_gap);
  const int n = general.impedance.n;
  for (int z = 0; z < n; ++z) {
    general.missing_hat[z] = X(matrices_.T_inverse * general.residual[z]);
    for (int k = 0; k < 3; ++k) f[k] -= general.impedance.pushes[k * n + z] * general.missing_hat[z];
  }
}

// The rates of a law's states, once the gap's acceleration is corrected. Eq. (3.17).
template <int N>
void LaneStageSolver<N>::move_states(General& general, const L* accel) const {
  const LawImpedance<X>& law = general.impedance;
  X gap[3];
  for (int k = 0; k < 3; ++k) gap[k] = once_ * (X(matrices_.T_inverse * accel[k]) - general.missing_gap[k]);
  for (int z = 0; z < law.n; ++z) {
    X move(0.0);
    for (int k = 0; k < 3; ++k) move += law.follows[3 * z + k] * gap[k];
    for (int y = 0; y < law.n; ++y) move -= mu_ * (law.inverse[z * law.n + y] * general.missing_hat[y]);
    general.rate[z] += matrices_.T * move.x;
  }
}

// The laws' own states at the stages, and the tails of their rates.
template <int N>
void LaneStageSolver<N>::write_states(const State& begin, const Joint& joint, std::vector<Stage>& stages, StageTails& tails) const {
  const General& general = general_[joint.general];
  const int n = general.impedance.n, first = system_.joints[joint.index].first_state;
  for (int z = 0; z < n; ++z) {
    const L tail = begin.law_rate[first + z] * matrices_.tail_of_start + matrices_.tail * general.rate[z];
    tails.law_rates[first + z] = Lanes<4>::of({tail[0], tail[1], tail[2], 0});
    for (int s = 0; s < N; ++s) {
      stages[s].law_state[first + z] = general.state[z][s];
      stages[s].law_rate[first + z] = general.rate[z][s];
    }
  }
}

}  // namespace pintle
