// GapProjector for all variants at once. theory/time section 4.
#pragma once

#include "fleet/fleet_parts.h"
#include "integrators/pose_blocks.h"

namespace pintle::PINTLE_FLEET {

/// Motions and readings at t, q, v.
PINTLE_PART inline void read(const FleetMechanism& mechanism, const Each& t, const EachVecs& q, const EachVecs& v, std::vector<FleetMotion>& m,
                             std::vector<FleetReading>& r) {
  mechanism.motions(q, v, m);
  mechanism.readings(t, m, r);
}

/// The same where only the velocities have changed.
PINTLE_PART inline void read_rates(const FleetMechanism& mechanism, const Each& t, const EachVecs& v, std::vector<FleetMotion>& m,
                                   std::vector<FleetReading>& r) {
  mechanism.rates(v, m);
  mechanism.readings(t, m, r);
}

/// What gaps of the bodies' x lack of those wanted: wanted - known - G x; `known` is a member of the readings.
PINTLE_PART inline void find_missing(const FleetMechanism& mechanism, const std::vector<FleetReading>& r, const EachVecs& wanted, EachVec FleetReading::*known,
                                     const EachVecs& x, EachVecs& missing) {
  for (std::size_t j = 0; j < r.size(); ++j) {
    const EachVec e = FleetMechanism::gap_change(mechanism.joints[j], r[j].map, x);
    for (int k = 0; k < 3; ++k) missing[j][k] = wanted[j][k] - (r[j].*known)[k] - e[k];
  }
}

class FleetProjector {
 public:
  explicit FleetProjector(const FleetMechanism& mechanism)
      : mechanism_(mechanism), lu_(mechanism.pattern(), Symmetry::kSymmetric), map_(mechanism.joints.size()), weight_(mechanism.joints.size()),
        body_(mechanism.n_bodies() + 1), missing_(mechanism.joints.size()) {}

  /// Factorises Z = mu^2 M + G' w G, w = K + mu C. Eq. (4.1).
  PINTLE_PART void prepare(const std::vector<FleetReading>& r, const Each& mu) {
    mu2_ = mu * mu;
    lu_.set_diagonal([this](int i, int k) { return mu2_ * mechanism_.bodies[i].mass[k]; });
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const FleetJoint& joint = mechanism_.joints[j];
      map_[j] = r[j].map;
      for (int k = 0; k < 3; ++k) weight_[j][k] = joint.k[k] + mu * joint.c[k];
      PoseBlocks<Each>::of(map_[j], weight_[j].a.data()).add_to(lu_, joint.at, joint.slot);
    }
    lu_.factorize();
  }

  /// x += Z^-1 G' w wanted. Eq. (4.2).
  PINTLE_PART void close(const EachVecs& wanted, EachVecs& x) {
    pull(wanted);
    solve();
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) x[i][k] += body_[i][k];
  }

  /// One pass of Eq. (4.4).
  PINTLE_PART void improve_forces(const EachVecs& Q, const EachVecs& a, EachVecs& force) {
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) body_[i][k] = Q[i][k] - mechanism_.bodies[i].mass[k] * a[i][k];
    for (std::size_t j = 0; j < map_.size(); ++j) FleetMechanism::add_force(mechanism_.joints[j], map_[j], force[j], body_);
    solve();
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const EachVec change = FleetMechanism::gap_change(mechanism_.joints[j], map_[j], body_);
      for (int k = 0; k < 3; ++k) force[j][k] -= weight_[j][k] * change[k];
    }
  }

  /// Eq. (4.5), with the convective accelerations of `r`; `a` is scratch.
  PINTLE_PART void balance(const std::vector<FleetReading>& r, const EachVecs& Q, const EachVecs& gap_accel, EachVecs& force, EachVecs& a) {
    a = Q;
    for (std::size_t j = 0; j < map_.size(); ++j) FleetMechanism::add_force(mechanism_.joints[j], map_[j], force[j], a);
    for (std::size_t i = 0; i < mechanism_.n_bodies(); ++i)
      for (int k = 0; k < 3; ++k) a[i][k] *= mechanism_.bodies[i].over_mass[k];
    a.back() = {};
    find_missing(mechanism_, r, gap_accel, &FleetReading::bias, a, missing_);
    pull(missing_);
    solve();
    const Each over_mu2 = reciprocal(mu2_);
    for (std::size_t j = 0; j < map_.size(); ++j) {
      const EachVec e = FleetMechanism::gap_change(mechanism_.joints[j], map_[j], body_);
      for (int k = 0; k < 3; ++k) force[j][k] += weight_[j][k] * over_mu2 * (missing_[j][k] - e[k]);
    }
  }

 private:
  PINTLE_LANES void pull(const EachVecs& wanted) {
    for (auto& x : body_) x = {};
    for (std::size_t j = 0; j < map_.size(); ++j) {
      EachVec f;
      for (int k = 0; k < 3; ++k) f[k] = weight_[j][k] * wanted[j][k];
      FleetMechanism::add_force(mechanism_.joints[j], map_[j], f, body_);
    }
  }
  PINTLE_LANES void solve() {
    lu_.solve(body_);
    body_.back() = {};
  }

  const FleetMechanism& mechanism_;
  BlockLu<Each, 3> lu_;
  std::vector<GapMap<Each>> map_;
  EachVecs weight_, body_, missing_;
  Each mu2_;
};

}  // namespace pintle::PINTLE_FLEET
