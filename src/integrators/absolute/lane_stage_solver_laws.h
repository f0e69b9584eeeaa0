// Joints in the stage solver whose law is more than springs and dampers: the law's own states at the stages, eliminated joint by joint.
// Included where it is compiled for registers of several widths. theory/time Eqs. (3.16)-(3.18).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "integrators/absolute/lane_stage_solver.h"

namespace pintle {

// Gaussian elimination with row pivoting: the right-hand side becomes the solution.
template <class Matrix>
void solve_in_place(Matrix& matrix, Eigen::Map<Eigen::VectorXd>& x) {
  const Eigen::Index n = x.size();
  for (Eigen::Index p = 0; p < n; ++p) {
    Eigen::Index best = p;
    for (Eigen::Index r = p + 1; r < n; ++r)
      if (std::abs(matrix(r, p)) > std::abs(matrix(best, p))) best = r;
    if (best != p) {
      for (Eigen::Index c = p; c < n; ++c) std::swap(matrix(p, c), matrix(best, c));
      std::swap(x[p], x[best]);
    }
    for (Eigen::Index r = p + 1; r < n; ++r) {
      const double factor = matrix(r, p) / matrix(p, p);
      if (factor == 0) continue;
      for (Eigen::Index c = p + 1; c < n; ++c) matrix(r, c) -= factor * matrix(p, c);
      x[r] -= factor * x[p];
    }
  }
  for (Eigen::Index p = n - 1; p >= 0; --p) {
    for (Eigen::Index c = p + 1; c < n; ++c) x[p] -= matrix(p, c) * x[c];
    x[p] /= matrix(p, p);
  }
}

// The states of a law at the stages, its force, and the residual of its states' equations. Where the residual could be felt in the
// force, the states are solved for first, at the present gaps. Eq. (3.19).
template <class S, int N>
void LaneStageSolver<S, N>::place_general(const BasicState<S>& begin, Joint& joint, const L* gap, const L* rate, L* force) {
  const BasicJointData<S>& data = system_.joints[joint.index];
  General& general = general_[joint.general];
  LawInput<L, S::kDof> in;
  in.t = L::all(begin.t) + step_.c;
  std::copy_n(gap, S::kDof, in.gap);
  std::copy_n(rate, S::kDof, in.rate);
  in.state = general.state.data();
  LawOutput<L, S::kDof> out;
  for (int pass = 0;; ++pass) {
    for (std::size_t z = 0; z < general.state.size(); ++z) general.state[z] = L::all(begin.law_state[data.first_state + z]) + step_.A * general.rate[z];
    data.law.evaluate(in, out);
    for (std::size_t z = 0; z < general.state.size(); ++z) general.residual[z] = general.rate[z] - out.state_rate[z];
    if (pass == kMostStatePasses || !miss_states(joint, general)) break;
    solve_states(begin.t, data.law, gap, rate, general);
  }
  std::copy_n(out.force, S::kDof, force);
}

// Whether the residual of the states' equations is felt in the joint's force, by the available tangents; or is comparable with the states themselves: bristles
// under no pressure exert no force, and would grow without bound.
template <class S, int N>
bool LaneStageSolver<S, N>::miss_states(const Joint& joint, const General& general) const {
  const BasicLawTangents<S>& tangents = general.tangents;
  L worst = L::all(0);
  for (int k = 0; k < S::kDof; ++k)
    for (int z = 0; z < tangents.n; ++z) worst = larger_size(worst, (joint.over_scale[k] * tangents.force_by_state[k][z] * step_.c[N - 1]) * general.residual[z]);
  for (int s = 0; s < N; ++s)
    if (worst[s] > NewtonContraction::kShare * tolerance_) return true;
  constexpr double kOfItself = 0.3;  // fraction of a state's size, above which what is missing in it is solved for
  for (std::size_t z = 0; z < general.state.size(); ++z) {
    double size = 0, missing = 0;
    for (int s = 0; s < N; ++s) {
      size = std::max(size, std::abs(general.state[z][s]));
      missing = std::max(missing, std::abs(step_.c[N - 1] * general.residual[z][s]));
    }
    if (missing > kOfItself * size) return true;
  }
  return false;
}

template <class S, int N>
void LaneStageSolver<S, N>::linearize_at(double t, const BasicLaw<S>& law, const L* gap, const L* rate, const General& general, int stage, BasicLawTangents<S>& tangents) const {
  typename S::Vec e, v;
  std::array<double, kMostLawStates> state;
  for (int k = 0; k < S::kDof; ++k) {
    e[k] = gap[k][stage];
    v[k] = rate[k][stage];
  }
  for (std::size_t z = 0; z < general.state.size(); ++z) state[z] = general.state[z][stage];
  law.linearize({t + step_.c[stage], e, v, state.data()}, tangents);
}

// One pass of Newton's method for the rates of a law's states at all stages, with the tangents of each stage. Eq. (3.19).
template <class S, int N>
void LaneStageSolver<S, N>::solve_states(double t, const BasicLaw<S>& law, const L* gap, const L* rate, General& general) {
  const int n = law.n_states(), size = N * n;
  Eigen::Map<RowMatrix> matrix(general.matrix.data(), size, size);
  Eigen::Map<Eigen::VectorXd> move(general.move.data(), size);
  for (int s = 0; s < N; ++s) {
    linearize_at(t, law, gap, rate, general, s, general.at_stage);
    for (int z = 0; z < n; ++z) {
      move[s * n + z] = -general.residual[z][s];
      for (int j = 0; j < N; ++j)
        for (int y = 0; y < n; ++y) matrix(s * n + z, j * n + y) = (s == j && z == y ? 1.0 : 0.0) - general.at_stage.by_state[z][y] * step_.A.column[j][s];
    }
  }
  solve_in_place(matrix, move);
  for (int z = 0; z < n; ++z)
    for (int s = 0; s < N; ++s) general.rate[z].set(s, general.rate[z][s] + move[s * n + z]);
}

// The forces that correct the residuals of a gap's equation and of the law's states' equations. Eq. (3.16).
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

// The laws' own states at the stages, and the tails of the forces due to them.
template <class S, int N>
void LaneStageSolver<S, N>::write_states(const BasicState<S>& begin, const Joint& joint, const L* gap, const L* rate, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const {
  const General& general = general_[joint.general];
  const int n = general.impedance.n, first = system_.joints[joint.index].first_state;
  for (int z = 0; z < n; ++z) {
    for (int s = 0; s < N; ++s) {
      stages[s].law_state[first + z] = general.state[z][s];
      stages[s].law_rate[first + z] = general.rate[z][s];
    }
  }
  if (n == 0) return;
  const BasicLaw<S>& law = system_.joints[joint.index].law;
  const typename S::Vec at_start = law.force_of_states(law_point(system_, joint.index, begin));
  L force[S::kDof];
  typename S::Vec e, v;
  for (int s = 0; s < N; ++s) {
    for (int k = 0; k < S::kDof; ++k) {
      e[k] = gap[k][s];
      v[k] = rate[k][s];
    }
    const typename S::Vec f = law.force_of_states({begin.t + step_.c[s], e, v, stages[s].law_state.data() + first});
    for (int k = 0; k < S::kDof; ++k) force[k].set(s, f[k]);
  }
  for (int k = 0; k < S::kDof; ++k) {
    const L tail = at_start[k] * matrices_.tail_of_start + matrices_.tail * force[k];
    tails.of_states[joint.index][k] = Lanes<4>::of({tail[0], tail[1], tail[2], 0});
  }
}

}  // namespace pintle
