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
  if (!joint.linear) {
    Planar::Vec gap, rate;
    for (int k = 0; k < 3; ++k) {
      L rates;
      gap[k] = place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rates)[i];
      rate[k] = rates[i];
    }
    const Response response = respond(system_.joints[j].law, gap, rate);
    for (int k = 0; k < 9; ++k) full_[joint.full][k] = response.stiffness(k / 3, k % 3) * twice_ + response.damping(k / 3, k % 3) * once_;
    add_joint(joint, response);
    return;
  }
  const Planar::Vec force(joint.force[0][i], joint.force[1][i], joint.force[2][i]);
  if (joint.function) {
    add_joint(joint, {force, Planar::Vec(joint.k[0], joint.k[1], joint.k[2]).asDiagonal(), Planar::Vec(joint.c[0], joint.c[1], joint.c[2]).asDiagonal()});
    return;
  }
  const X one(1.0);
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

// G' (K + mu C) G - N of one joint, of any kind.
template <int N>
void LaneStageSolver<N>::add_joint(const Joint& joint, const Response& tangents) {
  const JointData& data = system_.joints[joint.index];
  const Placement& at = data.at;
  const RelativePose pose = system_.pose(at, motions_);
  const JointKinematics r = read(data.displacement, pose);
  const auto geometric = geometric_stiffness(data.displacement, pose, tangents.force);
  const Planar::Mat KA = tangents.stiffness * r.GA(), KB = tangents.stiffness * r.GB(), CA = tangents.damping * r.GA(), CB = tangents.damping * r.GB();
  const Planar::Mat At = r.GA().transpose(), Bt = r.GB().transpose();
  if (at.a != kGround) add_block(lu_.diagonal(joint.a), At * KA - geometric.template block<3, 3>(0, 0), At * CA, mu_, 1);
  if (at.b != kGround) add_block(lu_.diagonal(joint.b), Bt * KB - geometric.template block<3, 3>(3, 3), Bt * CB, mu_, 1);
  if (at.a == kGround || at.b == kGround) return;
  BlockPattern::Slot slot = joint.slot;
  if (lu_.has(slot)) add_block(lu_.off_diagonal(slot), At * KB - geometric.template block<3, 3>(0, 3), At * CB, mu_, 1);
  slot.upper = !slot.upper;
  if (lu_.has(slot)) add_block(lu_.off_diagonal(slot), Bt * KA - geometric.template block<3, 3>(3, 0), Bt * CA, mu_, 1);
}

}  // namespace pintle
