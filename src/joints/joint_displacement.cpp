#include "joints/joint_displacement.h"

namespace pintle {
namespace {

// A scalar gap g(z): its kinematics by the chain rule, theory/joints Eq. (2.14).
template <class S>
BasicJointKinematics<S> read_scalar(const BasicGapFunction<S>& g, const typename S::RelativePose& pose) {
  const auto first = [](double x) -> typename S::Vec { return S::Vec::Unit(0) * x; };
  BasicJointKinematics<S> r;
  r.gap = first(g.gap);
  r.rate = first(g.gradient.dot(pose.rate));
  r.bias = first(g.gradient.dot(pose.bias) + pose.rate.dot(g.hessian * pose.rate));
  r.map = S::template GapMap<double>::of(pose);
  r.map.function = true;
  for (int k = 0; k < S::kDof; ++k) r.map.gradient[k] = g.gradient[k];
  return r;
}

template <class S, class F>
auto visit_scalar(const BasicDisplacement<S>& displacement, const typename S::Vec& z, F&& use) {
  return std::visit(
      [&](const auto& p) {
        if constexpr (std::is_same_v<std::decay_t<decltype(p)>, BasicSelection<S>>) {
          return use(static_cast<const BasicGapFunction<S>*>(nullptr), p.offset);
        } else {
          const BasicGapFunction<S> g = p(z);
          return use(&g, typename S::Vec(S::Vec::Zero()));
        }
      },
      displacement);
}

template <class Pose>
auto both(const Pose& pose) {
  constexpr int n = Pose::S::kDof;
  Eigen::Matrix<double, n, 2 * n> g;
  g << pose.GA(), pose.GB();
  return g;
}

}  // namespace

template <class S>
BasicJointKinematics<S> DisplacementReader<S>::read(const Displacement& displacement, const Pose& pose) {
  if (const auto* plain = std::get_if<BasicSelection<S>>(&displacement)) return pintle::read(*plain, pose);
  return visit_scalar<S>(displacement, pose.z, [&](const BasicGapFunction<S>* g, const Vec&) { return read_scalar<S>(*g, pose); });
}

template <class S>
auto DisplacementReader<S>::to_pose_force(const Displacement& displacement, const Pose& pose, const Vec& force) -> Vec {
  return visit_scalar<S>(displacement, pose.z, [&](const BasicGapFunction<S>* g, const Vec&) -> Vec { return g ? Vec(g->gradient * force[0]) : force; });
}

template <class S>
auto DisplacementReader<S>::geometric_stiffness(const Displacement& displacement, const Pose& pose, const Vec& force) -> Both {
  return visit_scalar<S>(displacement, pose.z, [&](const BasicGapFunction<S>* g, const Vec&) -> Both {
    if (!g) return pose.geometric(force);
    const auto G = both(pose);
    return pose.geometric(g->gradient * force[0]) + force[0] * G.transpose() * g->hessian * G;
  });
}

template <class S>
auto DisplacementReader<S>::rate_gradient(const Displacement& displacement, const Pose& pose, const typename S::Motion& A, const typename S::Motion& B) -> RateGradient {
  const RateGradient of_pose = pose.rate_gradient(A, B);
  return visit_scalar<S>(displacement, pose.z, [&](const BasicGapFunction<S>* g, const Vec&) -> RateGradient {
    if (!g) return of_pose;
    RateGradient r = RateGradient::Zero();
    r.row(0) = g->gradient.transpose() * of_pose + (g->hessian * pose.rate).transpose() * both(pose);
    return r;
  });
}

template struct DisplacementReader<Planar>;
template struct DisplacementReader<Spatial>;

}  // namespace pintle
