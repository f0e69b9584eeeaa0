#include "probes/probe.h"

namespace pintle {
namespace {

using S = Planar;

// A scalar gap g(z): its reading by the chain rule, theory/joints Eq. (2.14).
Reading read_scalar(const GapFunction& g, const RelativePose& pose) {
  Reading r;
  r.gap << g.gap, 0, 0;
  r.rate << g.gradient.dot(pose.rate), 0, 0;
  r.bias << g.gradient.dot(pose.bias) + pose.rate.dot(g.hessian * pose.rate), 0, 0;
  r.map = GapMap<double>::of(pose);
  r.map.function = true;
  for (int k = 0; k < S::kDof; ++k) r.map.gradient[k] = g.gradient[k];
  return r;
}

template <class F>
auto visit_scalar(const Probe& probe, const S::Vec& z, F&& use) {
  return std::visit(
      [&](const auto& p) {
        if constexpr (std::is_same_v<std::decay_t<decltype(p)>, Selection>) {
          return use(static_cast<const GapFunction*>(nullptr), p.offset);
        } else {
          const GapFunction g = p(z);
          return use(&g, S::Vec(S::Vec::Zero()));
        }
      },
      probe);
}

Eigen::Matrix<double, 3, 6> both(const RelativePose& pose) {
  Eigen::Matrix<double, 3, 6> g;
  g << pose.GA(), pose.GB();
  return g;
}

}  // namespace

Reading read(const Probe& probe, const RelativePose& pose) {
  if (const auto* plain = std::get_if<Selection>(&probe)) return read(*plain, pose);
  return visit_scalar(probe, pose.z, [&](const GapFunction* g, const S::Vec&) { return read_scalar(*g, pose); });
}

S::Vec to_pose_force(const Probe& probe, const RelativePose& pose, const S::Vec& force) {
  return visit_scalar(probe, pose.z, [&](const GapFunction* g, const S::Vec&) -> S::Vec {
    return g ? S::Vec(g->gradient * force[0]) : force;
  });
}

Eigen::Matrix<double, 6, 6> geometric_stiffness(const Probe& probe, const RelativePose& pose, const S::Vec& force) {
  return visit_scalar(probe, pose.z, [&](const GapFunction* g, const S::Vec&) -> Eigen::Matrix<double, 6, 6> {
    if (!g) return pose.geometric(force);
    const auto G = both(pose);
    return pose.geometric(g->gradient * force[0]) + force[0] * G.transpose() * g->hessian * G;
  });
}

Eigen::Matrix<double, 3, 6> rate_gradient(const Probe& probe, const RelativePose& pose, const S::Motion& A, const S::Motion& B) {
  const Eigen::Matrix<double, 3, 6> of_pose = pose.rate_gradient(A, B);
  return visit_scalar(probe, pose.z, [&](const GapFunction* g, const S::Vec&) -> Eigen::Matrix<double, 3, 6> {
    if (!g) return of_pose;
    Eigen::Matrix<double, 3, 6> r = Eigen::Matrix<double, 3, 6>::Zero();
    r.row(0) = g->gradient.transpose() * of_pose + (g->hessian * pose.rate).transpose() * both(pose);
    return r;
  });
}

}  // namespace pintle
