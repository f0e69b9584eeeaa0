// The matrix of the stages' equations, in lanes: what LaneStageSolver puts into it. Included where it is compiled for registers of several
// widths.
#pragma once

#include "integrators/absolute/lane_stage_solver.h"
#include "integrators/absolute/pose_blocks.h"
#include "laws/response.h"

namespace pintle {

// The eigenvalues that Z(mu) of Eq. (3.8) is made at.
template <int N>
void LaneStageSolver<N>::begin_matrix(double h) {
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

// The loads' slopes at the middle stage.
template <int N>
void LaneStageSolver<N>::add_loads(const State& begin, double h) {
  for (std::size_t b = 0; b < n_bodies(); ++b) motions_[bodies_[b].index] = bodies_[b].motion(kMiddle);
  const auto add = [this](int i, int j, const Planar::Mat& dq, const Planar::Mat& dv) {  // of a matrix that is not symmetric
    const int row = system_.pattern().position(i), column = system_.pattern().position(j);
    add_block(i == j ? lu_.diagonal(row) : lu_.off_diagonal(pattern_.slot(row, column)), dq, dv, mu_, -1);
  };
  system_.external_tangents(begin.t + table_.c[kMiddle] * h, motions_, add, begin.sliding);
}

// A joint's part of that, by its tangents at the middle stage, and its weights of Eq. (3.10).
template <int N>
void LaneStageSolver<N>::linearize(const State& begin, Joint& joint, const GapMap<L>& map) {
  constexpr int i = kMiddle;
  const int j = joint.index;
  joint.frozen = map.lane(i);
  const X one(1.0);
  if (!joint.linear) {
    const JointData& data = system_.joints[j];
    General& general = general_[joint.general];
    Planar::Vec gap, rate;
    double state[kMostLawStates];
    for (int k = 0; k < 3; ++k) {
      L rates;
      gap[k] = place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rates)[i];
      rate[k] = rates[i];
    }
    for (std::size_t z = 0; z < general.state.size(); ++z) state[z] = general.state[z][i];
    data.law.linearize({begin.t + step_.c[i], gap, rate, state}, general.tangents);
    general.impedance.find(general.tangents, mu_);
    for (int k = 0; k < 9; ++k) general.over_mu2[k] = twice_ * general.impedance.weight[k];
    add_joint(joint, general.impedance.weight, general.tangents.force);
    return;
  }
  const Planar::Vec force(joint.force[0][i], joint.force[1][i], joint.force[2][i]);
  if (joint.function) {
    X weight[9];
    for (int k = 0; k < 9; ++k) weight[k] = k % 4 == 0 ? joint.k[k / 4] * one + joint.c[k / 4] * mu_ : X(0.0);
    add_joint(joint, weight, force);
    return;
  }
  X w[3];
  for (int k = 0; k < 3; ++k) w[k] = joint.k[k] * one + joint.c[k] * mu_;
  PoseBlocks<X>::of(joint.frozen, w, force).add_to(lu_, body_or_ground(joint.a), body_or_ground(joint.b), joint.slot);
}

template <int N>
void LaneStageSolver<N>::add_block(Block<X, 3>& block, const Planar::Mat& K, const Planar::Mat& C, const X& mu, double sign) {
  const X one(1.0);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) block(r, c) += (sign * K(r, c)) * one + (sign * C(r, c)) * mu;
}

// G' w G - N of one joint of any kind, whose weight is any matrix.
template <int N>
void LaneStageSolver<N>::add_joint(const Joint& joint, const X* weight, const Planar::Vec& force) {
  const JointData& data = system_.joints[joint.index];
  const RelativePose pose = system_.pose(data.at, motions_);
  const JointKinematics r = read(data.displacement, pose);
  const auto geometric = geometric_stiffness(data.displacement, pose, force);
  const std::array<Planar::Mat, 2> G{r.GA(), r.GB()};
  const std::array<int, 2> body{body_or_ground(joint.a), body_or_ground(joint.b)};
  for (int column = 0; column < 2; ++column) {
    if (body[column] == kGround) continue;
    X force_by[3][3];  // w G
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) force_by[k][c] = G[column](0, c) * weight[3 * k] + G[column](1, c) * weight[3 * k + 1] + G[column](2, c) * weight[3 * k + 2];
    for (int row = 0; row < 2; ++row) {
      if (body[row] == kGround) continue;
      BlockPattern::Slot slot = joint.slot;
      if (row > column) slot.upper = !slot.upper;
      if (row != column && !lu_.has(slot)) continue;
      Block<X, 3>& block = row == column ? lu_.diagonal(row == 0 ? joint.a : joint.b) : lu_.off_diagonal(slot);
      for (int p = 0; p < 3; ++p)
        for (int c = 0; c < 3; ++c) {
          block(p, c) -= X(geometric(3 * row + p, 3 * column + c));
          for (int k = 0; k < 3; ++k) block(p, c) += G[row](k, p) * force_by[k][c];
        }
    }
  }
}

}  // namespace pintle
