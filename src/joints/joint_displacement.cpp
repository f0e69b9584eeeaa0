#include "joints/joint_displacement.h"

namespace pintle {
namespace {

template <class S>
bool selects(const BasicDisplacement<S>& displacement) { return std::holds_alternative<BasicSelection<S>>(displacement); }

template <class Pose>
auto both(const Pose& pose) {
  constexpr int n = Pose::S::kDof;
  Eigen::Matrix<double, n, 2 * n> g;
  g << pose.GA(), pose.GB();
  return g;
}

}  // namespace

// theory/joints Eq. (2.14).
template <class S>
BasicJointKinematics<S> DisplacementReader<S>::read(const Displacement& displacement, const Pose& pose) {
  if (const auto* plain = std::get_if<BasicSelection<S>>(&displacement)) return pintle::read(*plain, pose);
  BasicJointKinematics<S> r;
  r.gap = r.rate = r.bias = Vec::Zero();
  r.map = S::template GapMap<double>::of(pose);
  for_each_function(displacement, pose.z, [&](int k, const BasicGapFunction<S>& g) {
    r.gap[k] = g.gap;
    r.rate[k] = g.gradient.dot(pose.rate);
    r.bias[k] = g.gradient.dot(pose.bias) + pose.rate.dot(g.hessian * pose.rate);
    r.map.functions = k + 1;
    for (int c = 0; c < S::kDof; ++c) r.map.gradient[k][c] = g.gradient[c];
  });
  return r;
}

template <class S>
auto DisplacementReader<S>::to_pose_force(const Displacement& displacement, const Pose& pose, const Vec& force) -> Vec {
  if (selects<S>(displacement)) return force;
  Vec f = Vec::Zero();
  for_each_function(displacement, pose.z, [&](int k, const BasicGapFunction<S>& g) { f += g.gradient * force[k]; });
  return f;
}

template <class S>
auto DisplacementReader<S>::geometric_stiffness(const Displacement& displacement, const Pose& pose, const Vec& force) -> Both {
  if (selects<S>(displacement)) return pose.geometric(force);
  Vec f = Vec::Zero();
  typename S::Mat bend = S::Mat::Zero();
  for_each_function(displacement, pose.z, [&](int k, const BasicGapFunction<S>& g) {
    f += g.gradient * force[k];
    bend += force[k] * g.hessian;
  });
  const auto G = both(pose);
  return pose.geometric(f) + G.transpose() * bend * G;
}

template <class S>
auto DisplacementReader<S>::rate_gradient(const Displacement& displacement, const Pose& pose, const typename S::Motion& A, const typename S::Motion& B) -> RateGradient {
  const RateGradient of_pose = pose.rate_gradient(A, B);
  if (selects<S>(displacement)) return of_pose;
  RateGradient r = RateGradient::Zero();
  for_each_function(displacement, pose.z, [&](int k, const BasicGapFunction<S>& g) {
    r.row(k) = g.gradient.transpose() * of_pose + pose.rate.transpose() * g.hessian * both(pose);
  });
  return r;
}

// theory/joints Eq. (2.23).
Eigen::Matrix<double, 3, 6> bias_gradient(const JointDisplacement& displacement, const RelativePose& pose, const Planar::Motion& A, const Planar::Motion& B) {
  const auto of_pose = pose.bias_gradient(A, B);
  if (selects<Planar>(displacement)) return of_pose;
  const auto of_rate = pose.rate_gradient(A, B);
  Eigen::Matrix<double, 3, 6> r = Eigen::Matrix<double, 3, 6>::Zero();
  for_each_function(displacement, pose.z, [&](int k, const GapFunction& g) {
    r.row(k) = g.gradient.transpose() * of_pose + pose.bias.transpose() * g.hessian * both(pose) + 2 * pose.rate.transpose() * g.hessian * of_rate;
  });
  return r;
}

template struct DisplacementReader<Planar>;
PINTLE_IN_SPACE(template struct DisplacementReader<Spatial>;)

}  // namespace pintle
