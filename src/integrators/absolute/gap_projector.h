// Moves a state so that stiff joints have the required gaps, rates and accelerations, and finds the joint forces that
// go with them, theory/time section 4. "Stiff" is a matter of degree: each pass corrects a mode of frequency w by w^2 /
// (w^2 + mu^2), so that soft joints keep what they have, and directions that no motion can close (redundant joints)
// stay as the geometry has them. One factorisation serves all four operations.
#pragma once

#include "linalg/block_lu.h"
#include "simd/lanes.h"
#include "system/system.h"

namespace pintle {

template <class S>
class BasicGapProjector {
 public:
  explicit BasicGapProjector(const BasicSystem<S>& system);

  /// Factorises mu^2 M + G' (K + mu C) G at the configuration of `m`. False when singular. With `moved` (1 or 0 for every
  /// component of every gap) the components with 0 are left alone, as if they had no law.
  bool prepare(double t, const std::vector<typename S::Motion>& m, double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at,
               const VecsOf<S>* moved = nullptr);

  /// The same where the joint kinematics are known.
  bool prepare(const std::vector<BasicJointKinematics<S>>& joint_kinematics, double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at, const VecsOf<S>* moved = nullptr);

  /// Gaps, rates, Jacobians and convective terms of `m`; the factorisation is kept.
  void read(double t, const std::vector<typename S::Motion>& m) { system_.joint_kinematics(t, m, joint_kinematics_); }

  /// Adds to x the smallest displacement (in the mass norm) whose gap change is `wanted`, in one pass.
  void close(const VecsOf<S>& wanted, VecsOf<S>& x);
  /// Improves joint forces so that M a = Q + G' f in the stiff modes, in one pass; `a` has the required gap
  /// accelerations. Returns the largest change of a joint's force over the stiff components.
  double improve_forces(const VecsOf<S>& Q, const VecsOf<S>& a, VecsOf<S>& force);
  /// Improves joint forces so that in the stiff modes the accelerations M^-1 (Q + G' f) give the gaps' own, in one pass.
  void balance(const VecsOf<S>& Q, const VecsOf<S>& gap_accel, VecsOf<S>& force);

  const std::vector<BasicJointKinematics<S>>& joint_kinematics() const { return joint_kinematics_; }

 private:
  bool factorize(double mu, const VecsOf<S>& gap_at, const VecsOf<S>& rate_at, const VecsOf<S>* moved);
  typename S::Vec weigh(int j, const typename S::Vec& gap) const;

  const BasicSystem<S>& system_;
  BlockLu<double, S::kDof> lu_;
  std::vector<BasicJointKinematics<S>> joint_kinematics_;
  std::vector<typename S::Mat> weight_;  // K + mu C per joint
  std::vector<char> diagonal_;       // whether it is diagonal
  std::vector<BlockPattern::Slot> slots_;
  VecsOf<S> body_, accel_, missing_;
  double mu_ = 0;
};
using GapProjector = BasicGapProjector<Planar>;

}  // namespace pintle
