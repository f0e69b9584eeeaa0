#include "joints/joint_displacement.h"

namespace pintle {
namespace {

using S = Planar;

// A scalar gap g(z): its kinematics by the chain rule, theory/joints Eq. (2.14).
JointKinematics read_scalar(const GapFunction& g, const RelativePose& pose) {
  JointKinematics r;
  r.gap << g.gap, 0, 0;
  r.rate << g.gradient.dot(pose.rate), 0, 0;
  r.bias << g.gradient.dot(pose.bias) + pose.rate.dot(g.hessian * pose.rate), 0, 0;
  r.map = GapMap<double>::of(pose);
  r.map.function = true;
  for (int k = 0; k < S::kDof; ++k) r.map.gradient[k] = g.gradient[k];
  return r;
}

template <class F>
auto visit_scalar(const JointDisplacement& displacement, const S::Vec& z, F&& use) {
  return std::visit(
      [&](const auto& p) {
        if constexpr (std::is_same_v<std::decay_t<decltype(p)>, Selection>) {
          return use(static_cast<const GapFunction*>(nullptr), p.offset);
        } else {
          const GapFunction g = p(z);
          return use(&g, S::Vec(S::Vec::Zero()));
        }
      },
      displacement);
}

Eigen::Matrix<double, 3, 6> both(const RelativePose& pose) {
  Eigen::Matrix<double, 3, 6> g;
  g << pose.GA(), pose.GB();
  return g;
}

}  // namespace

JointKinematics read(const JointDisplacement& displacement, const RelativePose& pose) {
  if (const auto* plain = std::get_if<Selection>(&displacement)) return read(*plain, pose);
  return visit_scalar(displacement, pose.z, [&](const GapFunction* g, const S::Vec&) { return read_scalar(*g, pose); });
}

S::Vec to_pose_force(const JointDisplacement& displacement, const RelativePose& pose, const S::Vec& force) {
  return visit_scalar(displacement, pose.z, [&](const GapFunction* g, const S::Vec&) -> S::Vec {
    return g ? S::Vec(g->gradient * force[0]) : force;
  });
}

Eigen::Matrix<double, 6, 6> geometric_stiffness(const JointDisplacement& displacement, const RelativePose& pose, const S::Vec& force) {
  return visit_scalar(displacement, pose.z, [&](const GapFunction* g, const S::Vec&) -> Eigen::Matrix<double, 6, 6> {
    if (!g) return pose.geometric(force);
    const auto G = both(pose);
    return pose.geometric(g->gradient * force[0]) + force[0] * G.transpose() * g->hessian * G;
  });
}

Eigen::Matrix<double, 3, 6> rate_gradient(const JointDisplacement& displacement, const RelativePose& pose, const S::Motion& A, const S::Motion& B) {
  const Eigen::Matrix<double, 3, 6> of_pose = pose.rate_gradient(A, B);
  return visit_scalar(displacement, pose.z, [&](const GapFunction* g, const S::Vec&) -> Eigen::Matrix<double, 3, 6> {
    if (!g) return of_pose;
    Eigen::Matrix<double, 3, 6> r = Eigen::Matrix<double, 3, 6>::Zero();
    r.row(0) = g->gradient.transpose() * of_pose + (g->hessian * pose.rate).transpose() * both(pose);
    return r;
  });
}

}  // namespace pintle
