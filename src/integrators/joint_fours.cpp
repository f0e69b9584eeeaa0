#include "integrators/joint_fours.h"

#include <utility>

namespace pintle {
namespace {

void put(const JointData& data, const System& system, int lane, FourJoints& four) {
  const Placement& at = data.at;
  const auto body = [&](int index) { return index == kGround ? system.n_bodies() : index; };
  four.lane[lane] = four.first + four.n - 1;
  four.a[lane] = body(at.a);
  four.b[lane] = body(at.b);
  if (at.a != kGround && at.b != kGround) four.slot[lane] = system.pattern().slot(at.a, at.b);
  for (const auto& [foot, frame] : {std::pair(&four.F, &at.F), std::pair(&four.M, &at.M)}) {
    foot->p.across.set(lane, frame->p.x());
    foot->p.up.set(lane, frame->p.y());
    foot->c.set(lane, frame->c);
    foot->s.set(lane, frame->s);
    foot->angle.set(lane, frame->angle);
  }
  for (int k = 0; k < 3; ++k) {
    four.forbidden[k].set(lane, data.free_mask[k] == 0 ? 1 : 0);
    if (const auto* probe = std::get_if<Selection>(&data.probe)) four.offset[k].set(lane, probe->offset[k]);
    if (const LinearLaw* law = data.law.constant_diagonal()) {
      four.k[k].set(lane, law->k[k]);
      four.c[k].set(lane, law->c[k]);
    }
  }
}

}  // namespace

std::vector<FourJoints> joints_in_fours(const System& system) {
  std::vector<FourJoints> fours;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& data = system.joints[j];
    const bool linear = data.law.constant_diagonal() != nullptr, pose = linear && std::holds_alternative<Selection>(data.probe) && data.servo < 0;
    if (!pose || fours.empty() || !fours.back().pose || fours.back().n == 4) {
      FourJoints& four = fours.emplace_back();
      four.first = j;
      four.pose = pose;
      four.linear = linear;
    }
    FourJoints& four = fours.back();
    for (int lane = four.n++; lane < 4; ++lane) put(data, system, lane, four);
  }
  return fours;
}

}  // namespace pintle
