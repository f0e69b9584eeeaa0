#include "integrators/absolute/joint_pack.h"

#include <utility>

namespace pintle {
namespace {

template <class S>
void put(const BasicJointData<S>& data, const BasicSystem<S>& system, int lane, BasicJointPack<S>& pack) {
  const BasicPlacement<S>& at = data.at;
  const auto body = [&](int index) { return index == kGround ? system.n_bodies() : index; };
  pack.lane[lane] = pack.first + pack.n - 1;
  pack.a[lane] = body(at.a);
  pack.b[lane] = body(at.b);
  if (at.a != kGround && at.b != kGround) pack.slot[lane] = system.pattern().slot(at.a, at.b);
  pack.F.set(lane, at.F);
  pack.M.set(lane, at.M);
  for (int k = 0; k < S::kDof; ++k) {
    pack.forbidden[k].set(lane, data.free_mask[k] == 0 ? 1 : 0);
    pack.slides = pack.slides || (k < S::kDim && data.free_mask[k] != 0);
    if (const auto* displacement = std::get_if<BasicSelection<S>>(&data.displacement)) pack.offset[k].set(lane, displacement->offset[k]);
    if (const auto* law = data.law.as_linear()) {
      pack.k[k].set(lane, law->k[k]);
      pack.c[k].set(lane, law->c[k]);
    }
  }
}

}  // namespace

template <class S>
std::vector<BasicJointPack<S>> pack_joints(const BasicSystem<S>& system) {
  std::vector<BasicJointPack<S>> packs;
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& data = system.joints[j];
    const bool linear = data.law.as_linear() != nullptr, pose = linear && std::holds_alternative<BasicSelection<S>>(data.displacement) && data.servo < 0;
    if (!pose || packs.empty() || !packs.back().pose || packs.back().n == 4) {
      BasicJointPack<S>& pack = packs.emplace_back();
      pack.first = j;
      pack.pose = pose;
      pack.linear = linear;
    }
    BasicJointPack<S>& pack = packs.back();
    for (int lane = pack.n++; lane < 4; ++lane) put(data, system, lane, pack);
  }
  return packs;
}

template std::vector<BasicJointPack<Planar>> pack_joints(const BasicSystem<Planar>& system);
PINTLE_IN_SPACE(template std::vector<BasicJointPack<Spatial>> pack_joints(const BasicSystem<Spatial>& system);)

}  // namespace pintle
