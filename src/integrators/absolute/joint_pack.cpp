#include "integrators/absolute/joint_pack.h"

#include <utility>

namespace pintle {
namespace {

void put(const JointData& data, const System& system, int lane, JointPack& pack) {
  const Placement& at = data.at;
  const auto body = [&](int index) { return index == kGround ? system.n_bodies() : index; };
  pack.lane[lane] = pack.first + pack.n - 1;
  pack.a[lane] = body(at.a);
  pack.b[lane] = body(at.b);
  if (at.a != kGround && at.b != kGround) pack.slot[lane] = system.pattern().slot(at.a, at.b);
  for (const auto& [attachment, frame] : {std::pair(&pack.F, &at.F), std::pair(&pack.M, &at.M)}) {
    attachment->p.across.set(lane, frame->p.x());
    attachment->p.up.set(lane, frame->p.y());
    attachment->c.set(lane, frame->c);
    attachment->s.set(lane, frame->s);
    attachment->angle.set(lane, frame->angle);
  }
  for (int k = 0; k < 3; ++k) {
    pack.forbidden[k].set(lane, data.free_mask[k] == 0 ? 1 : 0);
    pack.slides = pack.slides || (k < 2 && data.free_mask[k] != 0);
    if (const auto* displacement = std::get_if<Selection>(&data.displacement)) pack.offset[k].set(lane, displacement->offset[k]);
    if (const LinearLaw* law = data.law.constant_diagonal()) {
      pack.k[k].set(lane, law->k[k]);
      pack.c[k].set(lane, law->c[k]);
    }
  }
}

}  // namespace

std::vector<JointPack> pack_joints(const System& system) {
  std::vector<JointPack> packs;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& data = system.joints[j];
    const bool linear = data.law.constant_diagonal() != nullptr, pose = linear && std::holds_alternative<Selection>(data.displacement) && data.servo < 0;
    if (!pose || packs.empty() || !packs.back().pose || packs.back().n == 4) {
      JointPack& pack = packs.emplace_back();
      pack.first = j;
      pack.pose = pose;
      pack.linear = linear;
    }
    JointPack& pack = packs.back();
    for (int lane = pack.n++; lane < 4; ++lane) put(data, system, lane, pack);
  }
  return packs;
}

}  // namespace pintle
