#include "integrators/radau/joint_pull.h"

namespace pintle {
namespace {

template <class S, class Geometric>
void add_rows(const BasicSystem<S>& system, const BasicPlacement<S>& at, const Geometric& geometric, std::vector<BodyPull<S>>& pulled) {
  constexpr int n = S::kDof;
  Eigen::Matrix<double, 2 * n, 1> size = Eigen::Matrix<double, 2 * n, 1>::Zero();
  const int body[2] = {at.a, at.b};
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < n && body[side] != kGround; ++k) size[n * side + k] = k < S::kDim ? 1 : 1 / system.bodies[body[side]].radius_of_gyration();
  const Eigen::Matrix<double, 2 * n, 1> sum = geometric.cwiseAbs() * size;
  for (int side = 0; side < 2; ++side) {
    if (body[side] == kGround) continue;
    pulled[body[side]][0] += sum.template segment<S::kDim>(n * side).maxCoeff();
    pulled[body[side]][1] += sum.template segment<n - S::kDim>(n * side + S::kDim).maxCoeff() / size[n * side + S::kDim];
  }
}

}  // namespace

template <class S>
void add_pull_of(int j, const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const typename S::Vec& force, std::vector<BodyPull<S>>& pulled) {
  const BasicJointData<S>& data = system.joints[j];
  const typename S::RelativePose pose = system.pose(data.at, m);
  if (!std::holds_alternative<BasicSelection<S>>(data.displacement)) return add_rows(system, data.at, geometric_stiffness(data.displacement, pose, force), pulled);
  const typename S::Vec forbidden = S::Vec::Ones() - data.free_mask;
  const auto pull = PullAcross<S, double>::of(S::template GapMap<double>::of(pose), force.data(), forbidden.data());
  if (data.at.a != kGround) pull.add_turn_of_first(0, pulled[data.at.a]);
  if (data.at.b != kGround) pull.add_turn_of_second(0, pulled[data.at.b]);
  add_slide(pull.slide, pull.arm_a, data.at.a, system, pulled);
  add_slide(pull.slide, pull.arm_b, data.at.b, system, pulled);
}

template void add_pull_of(int j, const BasicSystem<Planar>& system, const std::vector<Planar::Motion>& m, const Planar::Vec& force, std::vector<BodyPull<Planar>>& pulled);
PINTLE_IN_SPACE(template void add_pull_of(int j, const BasicSystem<Spatial>& system, const std::vector<Spatial::Motion>& m, const Spatial::Vec& force, std::vector<BodyPull<Spatial>>& pulled);)

}  // namespace pintle
