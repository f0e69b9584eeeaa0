// The displacement of a joint, its gap: what an ideal joint would forbid, with its rate, Jacobians and convective term.
#pragma once

#include <type_traits>
#include <variant>

#include "joints/gap_function.h"
#include "joints/gap_map.h"
#include "joints/relative_pose.h"

namespace pintle {

/// Joints whose gap is z itself, less an offset; the law has no stiffness in the components that stay free.
struct Selection {
  Planar::Vec offset = Planar::Vec::Zero();  // e.g. full turns of a weld's angle
};

using JointDisplacement = std::variant<Selection, Distance, Mesh, RackMesh, FunctionGap>;

/// The gap between two bodies as a law wants it; scalar gaps stand in component 0.
///   rate = GA vA + GB vB,   gap'' = GA aA + GB aB + bias
struct JointKinematics {
  Planar::Vec gap, rate, bias;
  GapMap<double> map;

  Planar::Mat GA() const { return map.GA(); }
  Planar::Mat GB() const { return map.GB(); }
};

/// The displacement at a relative pose, with what goes with it.
JointKinematics read(const JointDisplacement& displacement, const RelativePose& pose);
inline JointKinematics read(const Selection& displacement, const RelativePose& pose) { return {pose.z - displacement.offset, pose.rate, pose.bias, GapMap<double>::of(pose)}; }

/// The law's force as seen by z: J' f.
Planar::Vec to_pose_force(const JointDisplacement& displacement, const RelativePose& pose, const Planar::Vec& force);

/// d(G' f)/dq at constant f over (qA, qB): the geometric stiffness of the joint.
Eigen::Matrix<double, 6, 6> geometric_stiffness(const JointDisplacement& displacement, const RelativePose& pose, const Planar::Vec& force);

/// d(rate)/dq over (qA, qB).
Eigen::Matrix<double, 3, 6> rate_gradient(const JointDisplacement& displacement, const RelativePose& pose, const Planar::Motion& A,
                                          const Planar::Motion& B);

}  // namespace pintle
