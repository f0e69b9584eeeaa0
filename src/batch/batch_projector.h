// GapProjector for all variants at once. theory/time section 4.
#pragma once

#include "batch/batch_parts.h"
#include "integrators/absolute/pose_blocks.h"

namespace pintle::PINTLE_BATCH {

/// Motions and joint kinematics at t, q, v.
PINTLE_PART inline void read(const BatchMechanism& mechanism, const VariantLanes& t, const VariantVecs& q, const VariantVecs& v, std::vector<BatchMotion>& m,
                             std::vector<BatchJointKinematics>& r) {
  mechanism.motions(q, v, m);
  mechanism.joint_kinematics(t, m, r);
}

/// The same if only the velocities have changed.
PINTLE_PART inline void read_rates(const BatchMechanism& mechanism, const VariantLanes& t, const VariantVecs& v, std::vector<BatchMotion>& m,
                                   std::vector<BatchJointKinematics>& r) {
  mechanism.rates(v, m);
  mechanism.joint_kinematics(t, m, r);
}

/// What the gaps of the bodies' x lack compared with those wanted: wanted - known - G x; `known` is a member of the joint kinematics.
PINTLE_PART inline void find_missing(const BatchMechanism& mechanism, const std::vector<BatchJointKinematics>& r, const VariantVecs& wanted, VariantVec BatchJointKinematics::*known,
                                     const VariantVecs& x, VariantVecs& missing) {
  for (std::size_t j = 0; j < r.size(); ++j) {
    const VariantVec e = BatchMechanism::gap_change(mechanism.joints[j], r[j].map, x);
    for (int k = 0; k < 3; ++k) missing[j][k] = wanted[j][k] - (r[j].*known)[k] - e[k];
  }
}

class BatchProjector {
 public:
  explicit BatchProjector(const BatchMechanism& mechanism)
      : mechanism_(mechanism), lu_(mechanism.pattern(), Symmetry::kSymmetric), map_(mechanism.joints.size()), weight_(mechanism.joints.size()),
        body_(mechanism.n_bodies() + 1), missing_(mechanism.joints.size()) {}

  /// Factorises Z = mu^2 M + G' w G, w = K + mu C. Eq. (4.1).
  PINTLE_PART void prepare(const std::vector<BatchJointKinematics>& r, const VariantLanes& mu) {
    mu2_ = mu * mu;
    lu_.set_diagonal([this](int i, int k) { return mu2_ * mechanism_.bodies[i].mass[k]; });
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const BatchJoint& joint = mechanism_.joints[j];
      map_[j] = r[j].map;
      for (int k = 0; k < 3; ++k) weight_[j][k] = joint.k[k] + mu * joint.c[k];
      PoseBlocks<Planar, VariantLanes>::of(map_[j], weight_[j].a.data()).add_to(lu_, joint.at, joint.slot);
    }
    lu_.factorize();
  }

  /// x += Z^-1 G' w wanted. Eq. (4.2).
  PINTLE_PART void close(const VariantVecs& wanted, VariantVecs& x) {
    pull(wanted);
    solve();
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) x[i][k] += body_[i][k];
  }

  /// One pass of Eq. (4.4).
  PINTLE_PART void improve_forces(const VariantVecs& Q, const VariantVecs& a, VariantVecs& force) {
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) body_[i][k] = Q[i][k] - mechanism_.bodies[i].mass[k] * a[i][k];
    for (std::size_t j = 0; j < map_.size(); ++j) BatchMechanism::add_force(mechanism_.joints[j], map_[j], force[j], body_);
    solve();
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const VariantVec change = BatchMechanism::gap_change(mechanism_.joints[j], map_[j], body_);
      for (int k = 0; k < 3; ++k) force[j][k] -= weight_[j][k] * change[k];
    }
  }

  /// Eq. (4.5), with the convective accelerations of `r`; `a` is scratch.
  PINTLE_PART void balance(const std::vector<BatchJointKinematics>& r, const VariantVecs& Q, const VariantVecs& gap_accel, VariantVecs& force, VariantVecs& a) {
    a = Q;
    for (std::size_t j = 0; j < map_.size(); ++j) BatchMechanism::add_force(mechanism_.joints[j], map_[j], force[j], a);
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) a[i][k] *= mechanism_.bodies[i].over_mass[k];
    a.back() = {};
    find_missing(mechanism_, r, gap_accel, &BatchJointKinematics::bias, a, missing_);
    pull(missing_);
    solve();
    const VariantLanes over_mu2 = reciprocal(mu2_);
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const VariantVec e = BatchMechanism::gap_change(mechanism_.joints[j], map_[j], body_);
      for (int k = 0; k < 3; ++k) force[j][k] += weight_[j][k] * over_mu2 * (missing_[j][k] - e[k]);
    }
  }

 private:
  PINTLE_LANES void pull(const VariantVecs& wanted) {
    for (auto& x : body_) x = {};
    for (std::size_t j = 0; j < map_.size(); ++j) {
      VariantVec f;
      for (int k = 0; k < 3; ++k) f[k] = weight_[j][k] * wanted[j][k];
      BatchMechanism::add_force(mechanism_.joints[j], map_[j], f, body_);
    }
  }
  PINTLE_LANES void solve() {
    lu_.solve(body_);
    body_.back() = {};
  }

  const BatchMechanism& mechanism_;
  BlockLu<VariantLanes, 3> lu_;
  std::vector<GapMap<VariantLanes>> map_;
  VariantVecs weight_, body_, missing_;
  VariantLanes mu2_;
};

}  // namespace pintle::PINTLE_BATCH
