// The constraint Jacobian row by row: each gap component that a law resists, with its names.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "system/system.h"

namespace pintle {

struct ConstraintRow {
  int joint = 0;      // of the system
  int component = 0;  // of the gap
  bool servo = false;
  Eigen::RowVector3d on_a, on_b;  // d gap / dq of the two bodies
  double gap = 0;                 // [m] or [rad]
  double stiffness = 0, damping = 0;
  Eigen::RowVector3d stiffness_by, damping_by;  // with respect to all gap components: blades and bushings couple them
};

/// Rows of all joints, servos last as in the system. A rope that is slack by more than `reach` [m] has none.
std::vector<ConstraintRow> constraint_rows(const System& system, const std::vector<JointKinematics>& joint_kinematics, double reach);

/// A length of the mechanism: the root mean square of the arms at which its joints act [m].
double arm_length(const System& system, const std::vector<JointKinematics>& joint_kinematics);

/// "x", "across", "angle": the name of component k of a joint's gap, or of the coordinate that a servo drives.
std::string component_name(const JointData& joint, int k);

/// Kinematics at q, at rest, t = 0.
std::vector<JointKinematics> kinematics_at_rest(const System& system, const Vecs& q);

}  // namespace pintle
