// Joints in the stage solver whose law is more than springs and dampers: the law's own states at the stages, eliminated joint by joint.
// Included where it is compiled for registers of several widths. theory/time Eqs. (3.16)-(3.18).
#pragma once

#include <algorithm>

#include "integrators/absolute/lane_stage_solver.h"

namespace pintle {

// The states of a law at the stages, its force, and what is missing in its states' equations.
template <class S, int N>
void LaneStageSolver<S, N>::place_general(const BasicState<S>& begin, Joint& joint, const L* gap, const L* rate, L* force) {
  const BasicJointData<S>& data = system_.joints[joint.index];
  General& general = general_[joint.general];
  for (std::size_t z = 0; z < general.state.size(); ++z) general.state[z] = L::all(begin.law_state[data.first_state + z]) + step_.A * general.rate[z];
  LawInput<L, S::kDof> in;
  in.t = L::all(begin.t) + step_.c;
  std::copy_n(gap, S::kDof, in.gap);
  std::copy_n(rate, S::kDof, in.rate);
  in.state = general.state.data();
  LawOutput<L, S::kDof> out;
  data.law.evaluate(in, out);
  std::copy_n(out.force, S::kDof, force);
  for (std::size_t z = 0; z < general.state.size(); ++z) general.residual[z] = general.rate[z] - out.state_rate[z];
}

// The forces that answer what is missing in a gap's equation and in those of the law's states. Eq. (3.16).
template <class S, int N>
void LaneStageSolver<S, N>::answer_states(General& general, const X* missing, X* f) const {
  weigh<S::kDof>(false, general.over_mu2, missing, f);
  std::copy_n(missing, S::kDof, general.missing_gap);
  const int n = general.impedance.n;
  for (int z = 0; z < n; ++z) {
    general.missing_hat[z] = X(matrices_.T_inverse * general.residual[z]);
    for (int k = 0; k < S::kDof; ++k) f[k] -= general.impedance.pushes[k * n + z] * general.missing_hat[z];
  }
}

// The rates of a law's states, once the gap's acceleration is corrected. Eq. (3.17).
template <class S, int N>
void LaneStageSolver<S, N>::move_states(General& general, const L* accel) const {
  const LawImpedance<X, S>& law = general.impedance;
  X gap[S::kDof];
  for (int k = 0; k < S::kDof; ++k) gap[k] = once_ * (X(matrices_.T_inverse * accel[k]) - general.missing_gap[k]);
  for (int z = 0; z < law.n; ++z) {
    X move(0.0);
    for (int k = 0; k < S::kDof; ++k) move += law.follows[S::kDof * z + k] * gap[k];
    for (int y = 0; y < law.n; ++y) move -= mu_ * (law.inverse[z * law.n + y] * general.missing_hat[y]);
    general.rate[z] += matrices_.T * move.x;
  }
}

// The laws' own states at the stages, and the tails of their rates.
template <class S, int N>
void LaneStageSolver<S, N>::write_states(const BasicState<S>& begin, const Joint& joint, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const {
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
