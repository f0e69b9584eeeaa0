#include "integrators/radau/joint_pull.h"

namespace pintle {
namespace {

void add_rows(const System& system, const Placement& at, const Eigen::Matrix<double, 6, 6>& geometric, std::vector<BodyPull>& pulled) {
  Eigen::Matrix<double, 6, 1> size = Eigen::Matrix<double, 6, 1>::Zero();
  const int body[2] = {at.a, at.b};
  for (int side = 0; side < 2; ++side)
    if (body[side] != kGround) size.segment<3>(3 * side) << 1, 1, 1 / system.bodies[body[side]].radius_of_gyration();
  const Eigen::Matrix<double, 6, 1> sum = geometric.cwiseAbs() * size;
  for (int side = 0; side < 2; ++side) {
    if (body[side] == kGround) continue;
    pulled[body[side]][0] += std::max(sum[3 * side], sum[3 * side + 1]);
    pulled[body[side]][1] += sum[3 * side + 2] / size[3 * side + 2];
  }
}

}  // namespace

void add_pull_of(int j, const System& system, const std::vector<Planar::Motion>& m, const Planar::Vec& force, std::vector<BodyPull>& pulled) {
  const JointData& data = system.joints[j];
  const RelativePose pose = system.pose(data.at, m);
  if (!std::holds_alternative<Selection>(data.displacement)) return add_rows(system, data.at, geometric_stiffness(data.displacement, pose, force), pulled);
  const Planar::Vec forbidden = Planar::Vec::Ones() - data.free_mask;
  const auto pull = PullAcross<double>::of(GapMap<double>::of(pose), force[0], force[1], forbidden.data());
  if (data.at.a != kGround) pulled[data.at.a][2] += pull.turn_a;
  if (data.at.b != kGround) pulled[data.at.b][2] += pull.turn_b;
  add_slide(pull.slide, pull.arm_a, data.at.a, system, pulled);
  add_slide(pull.slide, pull.arm_b, data.at.b, system, pulled);
}

}  // namespace pintle
