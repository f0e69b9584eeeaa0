#include "integrators/absolute/gap_projector.h"

#include <algorithm>

#include "integrators/absolute/pose_blocks.h"

namespace pintle {

template <class S>
BasicGapProjector<S>::BasicGapProjector(const BasicSystem<S>& system)
    : system_(system), lu_(system.pattern(), symmetry_of_joints(system)), joint_kinematics_(system.joints.size()), weight_(system.joints.size(), S::Mat::Zero()), diagonal_(system.joints.size()),
      slots_(system.joints.size()), body_(system.bodies.size()),
      accel_(system.bodies.size()), missing_(system.joints.size()) {
  for (std::size_t j = 0; j < slots_.size(); ++j) {
    const BasicPlacement<S>& at = system.joints[j].at;
    diagonal_[j] = system.joints[j].law.as_linear() != nullptr;
    if (at.a != kGround && at.b != kGround) slots_[j] = system.pattern().slot(at.a, at.b);
  }
}

template <class S>
bool BasicGapProjector<S>::prepare(double t, const std::vector<typename S::Motion>& m, double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at,
                           const VecsOf<S>* moved) {
  system_.joint_kinematics(t, m, joint_kinematics_);
  return factorize(mu, gap_at, rate_at, moved);
}

template <class S>
bool BasicGapProjector<S>::prepare(const std::vector<BasicJointKinematics<S>>& joint_kinematics, double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at, const VecsOf<S>* moved) {
  joint_kinematics_ = joint_kinematics;
  return factorize(mu, gap_at, rate_at, moved);
}

template <class S>
bool BasicGapProjector<S>::factorize(double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at, const VecsOf<S>* moved) {
  mu_ = mu;
  lu_.set_diagonal([&](int b, int k) { return mu * mu * system_.bodies[b].mass[k]; });
  for (int j = 0; j < system_.n_joints(); ++j) {
    const BasicLaw<S>& law = system_.joints[j].law;
    const auto* linear = law.as_linear();
    if (linear) {
      weight_[j].diagonal() = linear->k + mu * linear->c;
    } else {
      const BasicResponse<S> response = respond(law, gap_at[j], rate_at[j]);
      weight_[j] = response.stiffness + mu * response.damping;
    }
    if (moved) weight_[j] = (*moved)[j].asDiagonal() * weight_[j] * (*moved)[j].asDiagonal();
    if (linear && joint_kinematics_[j].map.functions == 0)
      PoseBlocks<S, double>::of(joint_kinematics_[j].map, typename S::Vec(weight_[j].diagonal()).data()).add_to(lu_, system_.joints[j].at, slots_[j]);
    else add_gap_blocks(lu_, system_.joints[j].at, slots_[j], joint_kinematics_[j].map, weight_[j]);
  }
  return lu_.factorize();
}

template <class S>
typename S::Vec BasicGapProjector<S>::weigh(int j, const typename S::Vec& gap) const {
  if (diagonal_[j]) return weight_[j].diagonal().cwiseProduct(gap);
  return weight_[j] * gap;
}

template <class S>
void BasicGapProjector<S>::close(const VecsOf<S>& wanted, VecsOf<S>& x) {
  for (auto& b : body_) b.setZero();
  for (int j = 0; j < system_.n_joints(); ++j) {
    const typename S::Vec f = weigh(j, wanted[j]);
    add_force(system_.joints[j].at, joint_kinematics_[j], f, body_);
  }
  lu_.solve(body_);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += body_[i];
}

// theory/time Eq. (4.4).
template <class S>
double BasicGapProjector<S>::improve_forces(const VecsOf<S>& Q, const VecsOf<S>& a, VecsOf<S>& force) {
  for (int i = 0; i < system_.n_bodies(); ++i) body_[i] = Q[i] - system_.bodies[i].mass.cwiseProduct(a[i]);
  for (int j = 0; j < system_.n_joints(); ++j) add_force(system_.joints[j].at, joint_kinematics_[j], force[j], body_);
  lu_.solve(body_);
  double largest = 0;
  for (int j = 0; j < system_.n_joints(); ++j) {
    const typename S::Vec change = weigh(j, gap_change(system_.joints[j].at, joint_kinematics_[j], body_));
    largest = std::max(largest, change.template head<S::kDim>().norm());
    force[j] -= change;
  }
  return largest;
}

// theory/time Eq. (4.5).
template <class S>
void BasicGapProjector<S>::balance(const VecsOf<S>& Q, const VecsOf<S>& gap_accel, VecsOf<S>& force) {
  accel_ = Q;
  for (int j = 0; j < system_.n_joints(); ++j) add_force(system_.joints[j].at, joint_kinematics_[j], force[j], accel_);
  for (int i = 0; i < system_.n_bodies(); ++i) accel_[i] = accel_[i].cwiseQuotient(system_.bodies[i].mass);
  const auto take_off = [&](const VecsOf<S>& a) {
    for (int j = 0; j < system_.n_joints(); ++j) subtract_gap(system_.joints[j].at, joint_kinematics_[j], a, missing_[j]);
  };
  for (int j = 0; j < system_.n_joints(); ++j) missing_[j] = gap_accel[j] - joint_kinematics_[j].bias;
  take_off(accel_);
  for (auto& x : accel_) x.setZero();
  close(missing_, accel_);
  take_off(accel_);
  for (int j = 0; j < system_.n_joints(); ++j) force[j] += weight_[j] * missing_[j] / (mu_ * mu_);
}

template class BasicGapProjector<Planar>;
PINTLE_IN_SPACE(template class BasicGapProjector<Spatial>;)

}  // namespace pintle
