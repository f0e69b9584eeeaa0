#include "integrators/general/force_tangents.h"

#include <algorithm>
#include <cmath>

namespace pintle {

namespace {

using S = Planar;

}  // namespace

ForceTangents::ForceTangents(const System& system)
    : system_(system), joint_places_(system.joints.size()),
      by_q_(system.bodies.size() + 2 * static_cast<std::size_t>(system.pattern().n_off_diagonal()), S::Mat::Zero()), by_v_(by_q_) {
  for (std::size_t j = 0; j < joint_places_.size(); ++j) {
    const std::array<int, 2> body{system.joints[j].at.a, system.joints[j].at.b};
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 2; ++column)
        joint_places_[j][2 * row + column] =
            body[row] == kGround || body[column] == kGround ? -1 : place(body[row], body[column]);
  }
}

int ForceTangents::place(int row, int column) const {
  if (row == column) return row;
  const BlockPattern::Slot slot = system_.pattern().slot(row, column);
  return system_.n_bodies() + slot.index + (slot.upper ? 0 : system_.pattern().n_off_diagonal());
}

// theory/solvers Eq. (1.3).
void ForceTangents::add_joint(int j, double t, const std::vector<double>& law_state, double mu, const ConstraintForces* constraints) {
  const JointData& joint = system_.joints[j];
  const S::Motion &A = motion_of(joint.at.a, motions_), &B = motion_of(joint.at.b, motions_);
  const JointKinematics r = system_.kinematics(j, t, motions_);
  const RelativePose pose = system_.pose(joint.at, motions_);
  if (constraints != nullptr && joint.ideal) {
    law_.n = 0;
    law_.force = constraints->force()[j];
    law_.stiffness = constraints->stiffness()[j].asDiagonal();
    law_.damping.setZero();
  } else {
    joint.law.linearize({t, r.gap, r.rate, law_state.data() + joint.first_state}, law_);
  }
  const auto geometric = geometric_stiffness(joint.displacement, pose, law_.force);
  const auto rate_by_q = rate_gradient(joint.displacement, pose, A, B);
  const std::array<S::Mat, 2> G{r.GA(), r.GB()};
  if (law_.n > 0) states_.push_back({j, law_, G, {S::Mat(rate_by_q.block<3, 3>(0, 0)), S::Mat(rate_by_q.block<3, 3>(0, 3))}});
  if (law_.n > 0 && std::isfinite(mu)) {
    follows_.reserve(law_.n);
    follows_.find(law_, mu);
    for (int k = 0; k < 3; ++k)
      for (int z = 0; z < law_.n; ++z)
        for (int c = 0; c < 3; ++c) {
          law_.stiffness(k, c) -= follows_.pushes[k * law_.n + z] * law_.by_gap[z][c];
          law_.damping(k, c) -= follows_.pushes[k * law_.n + z] * law_.by_rate[z][c];
        }
  }
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) {
      const int at = joint_places_[j][2 * row + column];
      if (at < 0) continue;
      const S::Mat force_by_q = -law_.stiffness * G[column] - law_.damping * rate_by_q.block<3, 3>(0, 3 * column);
      by_q_[at] += geometric.block<3, 3>(3 * row, 3 * column) + G[row].transpose() * force_by_q;
      by_v_[at] -= G[row].transpose() * law_.damping * G[column];
    }
}

void ForceTangents::find(double t, const Vecs& q, const Vecs& v, const std::vector<double>& law_state, double mu, const ConstraintForces* constraints) {
  states_.clear();
  system_.motions(q, v, motions_);
  std::fill(by_q_.begin(), by_q_.end(), S::Mat::Zero());
  std::fill(by_v_.begin(), by_v_.end(), S::Mat::Zero());
  for (int j = 0; j < system_.n_joints(); ++j) add_joint(j, t, law_state, mu, constraints);
  system_.external_tangents(t, motions_, [this](int i, int j, const S::Mat& dq, const S::Mat& dv) {
    const int at = place(i, j);
    by_q_[at] += dq;
    by_v_[at] += dv;
  });
}

void ForceTangents::combine(double mass, double by_q, double by_v, BlockLu<double, S::kDof>& lu) const {
  const int n = system_.n_bodies(), n_off = system_.pattern().n_off_diagonal();
  const auto put = [&](int at, Block<double, S::kDof>& block) {
    for (int r = 0; r < S::kDof; ++r)
      for (int c = 0; c < S::kDof; ++c) block(r, c) = -by_q * by_q_[at](r, c) - by_v * by_v_[at](r, c);
  };
  for (int i = 0; i < n; ++i) {
    Block<double, S::kDof>& block = lu.diagonal(i);
    put(i, block);
    for (int r = 0; r < S::kDof; ++r) block(r, r) += mass * system_.bodies[i].mass[r];
  }
  for (int k = 0; k < n_off; ++k) {
    put(n + k, lu.upper_at(k));
    put(n + n_off + k, lu.lower_at(k));
  }
}

}  // namespace pintle
