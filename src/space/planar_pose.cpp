#include "space/planar_pose.h"

#include "space/planar_joint_jacobian.h"

namespace pintle {

PlanarRelativePose::S::Mat PlanarRelativePose::GA() const { return PlanarGapMap<double>::of(*this).GA(); }
PlanarRelativePose::S::Mat PlanarRelativePose::GB() const { return PlanarGapMap<double>::of(*this).GB(); }

Eigen::Matrix<double, 6, 6> PlanarRelativePose::geometric(const S::Vec& f) const {
  const S::Point F = world_force(f), JF = S::perp(F);
  Eigen::Matrix<double, 6, 6> k = Eigen::Matrix<double, 6, 6>::Zero();
  // Rows: the force and moment on A, then on B. Turning A turns the force; moving the points moves the arms.
  k.block<2, 1>(0, 2) = -JF;
  k.block<2, 1>(3, 2) = JF;
  k.block<1, 2>(2, 0) = -JF.transpose();
  k.block<1, 2>(2, 3) = JF.transpose();
  k(2, 2) = -arm_a.dot(F);
  k(2, 5) = k(5, 2) = arm_b.dot(F);
  k(5, 5) = -arm_b.dot(F);
  return k;
}

Eigen::Matrix<double, 3, 6> PlanarRelativePose::rate_gradient(const S::Motion& A, const S::Motion& B) const {
  Eigen::Matrix<double, 3, 6> g = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Matrix2d to_F, turn;
  to_F << c, s, -s, c;
  turn << 0, -1, 1, 0;
  g.block<2, 2>(0, 0) = A.w * to_F * turn;
  g.block<2, 2>(0, 3) = -A.w * to_F * turn;
  g.block<2, 1>(0, 2) = -turn * rate.head<2>();
  g.block<2, 1>(0, 5) = (A.w - B.w) * (to_F * arm_b);
  return g;
}

Eigen::Matrix<double, 3, 6> PlanarRelativePose::bias_gradient(const S::Motion& A, const S::Motion& B) const {
  Eigen::Matrix<double, 3, 6> g = Eigen::Matrix<double, 3, 6>::Zero();
  Eigen::Matrix2d to_F;
  to_F << c, s, -s, c;
  // In world axes (2.3) is -wA^2 arm_a - 2 wA J (vM - vA) - wB^2 arm_b, with vM the velocity of M's origin.
  const double wa = A.w, relative = A.w - B.w;
  g.block<2, 2>(0, 0) = wa * wa * to_F;
  g.block<2, 2>(0, 3) = -wa * wa * to_F;
  g.block<2, 1>(0, 2) = S::Point(bias.y(), -bias.x());
  g.block<2, 1>(0, 5) = -relative * relative * (to_F * S::perp(arm_b));
  return g;
}

}  // namespace pintle
