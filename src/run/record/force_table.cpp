#include "run/record/force_table.h"

namespace pintle {

template <class S>
typename S::Vec joint_load(const BasicSystem<S>& system, int j, const std::vector<typename S::Motion>& m, const typename S::Vec& force) {
  const BasicJointData<S>& joint = system.joints[j];
  const typename S::RelativePose pose = system.pose(joint.at, m);
  const typename S::Vec f = to_pose_force(joint.displacement, pose, force);
  typename S::Vec load;
  load << pose.world_force(f), pose.world_couple(f);
  return load;
}

template <class S>
bool transmits_couple(const BasicJointData<S>& joint) {
  const typename S::Vec stiffness = joint.law.engaged_stiffness();
  for (int k = S::kDim; k < S::kDof; ++k)
    if (joint.held[k] && stiffness[k] > 0) return true;
  return joint.law.acts_without_reaction() && joint.free_mask.template head<S::kDim>().isZero();  // stops, a detent
}

template <class S>
bool has_couple(const BasicJointData<S>& joint) {
  return joint.servo >= 0 || transmits_couple(joint) || joint.law.lever() > 0;
}

template Planar::Vec joint_load(const System& system, int j, const std::vector<Planar::Motion>& m, const Planar::Vec& force);
PINTLE_IN_SPACE(template Spatial::Vec joint_load(const BasicSystem<Spatial>& system, int j, const std::vector<Spatial::Motion>& m, const Spatial::Vec& force);)
template bool transmits_couple(const JointData& joint);
PINTLE_IN_SPACE(template bool transmits_couple(const BasicJointData<Spatial>& joint);)
template bool has_couple(const JointData& joint);
PINTLE_IN_SPACE(template bool has_couple(const BasicJointData<Spatial>& joint);)

}  // namespace pintle
