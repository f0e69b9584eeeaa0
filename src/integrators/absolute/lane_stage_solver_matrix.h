// The matrix of the stage equations, in lanes, as LaneStageSolver assembles it. Included where it is compiled for registers of several
// widths.
#pragma once

#include "integrators/absolute/lane_stage_solver.h"
#include "integrators/absolute/pose_blocks.h"
#include "laws/response.h"

namespace pintle {

// The eigenvalues at which Z(mu) of Eq. (3.8) is formed.
template <class S, int N>
void LaneStageSolver<S, N>::begin_matrix(double h) {
  mu_ = (1 / h) * matrices_.eigenvalue;
  mu2_ = mu_ * mu_;
  once_ = reciprocal(mu_);
  twice_ = once_ * once_;
  const LaneMatrix<N>& T = matrices_.T;
  for (int p = 0; p < N - 1; p += 2) {
    const double re = mu2_.x[p], im = mu2_.x[p + 1];
    back_.column[p] = re * T.column[p] + im * T.column[p + 1];
    back_.column[p + 1] = re * T.column[p + 1] - im * T.column[p];
  }
  back_.column[N - 1] = mu2_.x[N - 1] * T.column[N - 1];
}

// Adds the loads' tangents at the middle stage.
template <class S, int N>
void LaneStageSolver<S, N>::add_loads(const BasicState<S>& begin, double h) {
  for (std::size_t b = 0; b < n_bodies(); ++b) motions_[bodies_[b].index] = bodies_[b].motion(kMiddle);
  const auto add = [this](int i, int j, const typename S::Mat& dq, const typename S::Mat& dv) {  // of a matrix that is not symmetric
    const int row = system_.pattern().position(i), column = system_.pattern().position(j);
    add_block(i == j ? lu_.diagonal(row) : lu_.off_diagonal(pattern_.slot(row, column)), dq, dv, mu_, -1);
  };
  system_.external_tangents(begin.t + table_.c[kMiddle] * h, motions_, add, begin.sliding);
}

// Adds a joint's part of the matrix, from its tangents at the middle stage, and finds its weights of Eq. (3.10).
template <class S, int N>
void LaneStageSolver<S, N>::linearize(const BasicState<S>& begin, Joint& joint, const typename S::template GapMap<L>& map) {
  constexpr int i = kMiddle;
  const int j = joint.index;
  joint.frozen = map.lane(i);
  const X one(1.0);
  if (!joint.linear) {
    const BasicJointData<S>& data = system_.joints[j];
    General& general = general_[joint.general];
    L gap[S::kDof], rate[S::kDof];
    for (int k = 0; k < S::kDof; ++k) gap[k] = step_.place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rate[k]);
    linearize_at(begin.t, data.law, gap, rate, general, i, general.tangents);
    general.impedance.find(general.tangents, mu_);
    for (int k = 0; k < S::kDof * S::kDof; ++k) general.over_mu2[k] = twice_ * general.impedance.weight[k];
    add_joint(joint, general.impedance.weight, general.tangents.force);
    return;
  }
  typename S::Vec force;
  for (int k = 0; k < S::kDof; ++k) force[k] = joint.force[k][i];
  if (joint.functions > 0) {
    X weight[S::kDof * S::kDof];
    for (int k = 0; k < S::kDof * S::kDof; ++k) weight[k] = k % (S::kDof + 1) == 0 ? joint.k[k / (S::kDof + 1)] * one + joint.c[k / (S::kDof + 1)] * mu_ : X(0.0);
    add_joint(joint, weight, force);
    return;
  }
  X w[S::kDof];
  for (int k = 0; k < S::kDof; ++k) w[k] = joint.k[k] * one + joint.c[k] * mu_;
  PoseBlocks<S, X>::of(joint.frozen, w, force).add_to(lu_, body_or_ground(joint.a), body_or_ground(joint.b), joint.slot);
}

template <class S, int N>
void LaneStageSolver<S, N>::add_block(Block<X, S::kDof>& block, const typename S::Mat& K, const typename S::Mat& C, const X& mu, double sign) {
  const X one(1.0);
  for (int r = 0; r < S::kDof; ++r)
    for (int c = 0; c < S::kDof; ++c) block(r, c) += (sign * K(r, c)) * one + (sign * C(r, c)) * mu;
}

// Adds G' w G - N of one joint of any kind, with any weight matrix.
template <class S, int N>
void LaneStageSolver<S, N>::add_joint(const Joint& joint, const X* weight, const typename S::Vec& force) {
  const BasicJointData<S>& data = system_.joints[joint.index];
  const typename S::RelativePose pose = system_.pose(data.at, motions_);
  const BasicJointKinematics<S> r = read(data.displacement, pose);
  const auto geometric = geometric_stiffness(data.displacement, pose, force);
  const std::array<typename S::Mat, 2> G{r.GA(), r.GB()};
  const std::array<int, 2> body{body_or_ground(joint.a), body_or_ground(joint.b)};
  for (int column = 0; column < 2; ++column) {
    if (body[column] == kGround) continue;
    X force_by[S::kDof][S::kDof];  // w G
    for (int k = 0; k < S::kDof; ++k)
      for (int c = 0; c < S::kDof; ++c) {
        if (joint.linear) {
          force_by[k][c] = G[column](k, c) * weight[(S::kDof + 1) * k];
          continue;
        }
        force_by[k][c] = G[column](0, c) * weight[S::kDof * k];
        for (int i = 1; i < S::kDof; ++i) force_by[k][c] += G[column](i, c) * weight[S::kDof * k + i];
      }
    for (int row = 0; row < 2; ++row) {
      if (body[row] == kGround) continue;
      BlockPattern::Slot slot = joint.slot;
      if (row > column) slot.upper = !slot.upper;
      if (row != column && !lu_.has(slot)) continue;
      Block<X, S::kDof>& block = row == column ? lu_.diagonal(row == 0 ? joint.a : joint.b) : lu_.off_diagonal(slot);
      for (int p = 0; p < S::kDof; ++p)
        for (int c = 0; c < S::kDof; ++c) {
          block(p, c) -= X(geometric(S::kDof * row + p, S::kDof * column + c));
          for (int k = 0; k < S::kDof; ++k) block(p, c) += G[row](k, p) * force_by[k][c];
        }
    }
  }
}

}  // namespace pintle
