#include "integrators/bend_watch.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "joints/cam_profile.h"
#include "joints/edge_profile.h"
#include "laws/law.h"

namespace pintle {

template <class S>
BasicBendWatch<S>::BasicBendWatch(const BasicSystem<S>& system) : system_(system) {
  const auto add = [this](int joint, int component, const Bends& bends) {
    if (!bends.empty()) ways_.push_back({joint, component, bends});
  };
  for (int j = 0; j < system.n_joints(); ++j) {
    const BasicJointData<S>& joint = system.joints[j];
    if (joint.ideal) continue;
    for (const auto& part : joint.law.parts()) {
      const auto [component, bends] = part->bends();
      add(j, component, bends);
    }
    std::visit([&](const auto& displacement) {
      if constexpr (requires { displacement.profile->bends(); }) add(j, -1, displacement.profile->bends());
    }, joint.displacement);
  }
}

template <class S>
double BasicBendWatch<S>::place(const Way& way, const std::vector<typename S::Motion>& m) const {
  const BasicJointData<S>& joint = system_.joints[way.joint];
  const typename S::RelativePose pose = system_.pose(joint.at, m);
  if (way.component >= 0) return read(joint.displacement, pose).gap[way.component];
  if constexpr (!S::kCurved)
    if (const auto* cam = std::get_if<CamGap>(&joint.displacement)) return cam->profile->place(pose.z).angle;
  return pose.z[0];
}

// The place on a cam is known up to whole turns, and turns with the follower.
template <class S>
double BasicBendWatch<S>::end_of(const Way& way, double from, const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const {
  const double to = place(way, end);
  if (way.component >= 0 || way.bends.period == 0) return to;
  const BasicPlacement<S>& at = system_.joints[way.joint].at;
  const double turned = system_.pose(at, end).z[2] - system_.pose(at, start).z[2];
  return from + turned + std::remainder(to - from - turned, way.bends.period);
}

template <class S>
double BasicBendWatch<S>::share_of_step(const std::vector<typename S::Motion>& start, const std::vector<typename S::Motion>& end) const {
  double share = 1;
  for (const Way& way : ways_) {
    const double from = place(way, start);
    share = std::min(share, way.bends.share_to_second(from, end_of(way, from, start, end)));
  }
  return share;
}

template class BasicBendWatch<Planar>;
PINTLE_IN_SPACE(template class BasicBendWatch<Spatial>;)

}  // namespace pintle
