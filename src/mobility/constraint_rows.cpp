#include "mobility/constraint_rows.h"

#include <algorithm>
#include <cmath>

#include "joints/catalog.h"

namespace pintle {

using S = Planar;

std::string component_name(const JointData& joint, int k) {
  if (joint.servo >= 0) return k == 2 ? "angle" : "slide";
  const JointTypeInfo* type = find_joint_type(joint.type);
  if (!type) return std::to_string(k);
  std::vector<std::string_view> lengths;
  for (const ComponentInfo& info : type->gap) {
    if (info.angular && k == 2) return std::string(info.name);
    if (!info.angular) lengths.push_back(info.name);
  }
  if (lengths.empty()) return std::to_string(k);
  return std::string(lengths.size() == 2 && k < 2 ? lengths[k] : lengths[0]);
}

std::vector<ConstraintRow> constraint_rows(const System& system, const std::vector<JointKinematics>& joint_kinematics, double reach) {
  std::vector<ConstraintRow> rows;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    const JointKinematics& r = joint_kinematics[j];
    Response law = respond(joint.law, r.gap, S::Vec::Zero());
    for (const double way : {reach, -reach})  // a rope is taut beyond its length, surfaces press below a distance of zero
      if (!(law.stiffness.diagonal().maxCoeff() > 0)) law = respond(joint.law, r.gap + S::Vec::Constant(way), S::Vec::Zero());
    for (int k = 0; k < S::kDof; ++k) {
      if (!(law.stiffness(k, k) > 0)) continue;
      rows.push_back(
          {j, k, joint.servo >= 0, r.GA().row(k), r.GB().row(k), r.gap[k], law.stiffness(k, k), law.damping(k, k), law.stiffness.row(k), law.damping.row(k)});
    }
  }
  return rows;
}

double arm_length(const System& system, const std::vector<JointKinematics>& joint_kinematics) {
  double sum = 0;
  int count = 0;
  for (int j = 0; j < system.n_joints(); ++j) {
    const JointData& joint = system.joints[j];
    const Placement& at = joint.at;
    double deflection = 0;  // arms are measured from the other marker: for a rotor on its pin they are just the pin's deflection
    for (int k = 0; k < 2; ++k)
      if (joint.held[k]) deflection = std::max(deflection, std::abs(joint_kinematics[j].gap[k]));
    for (int k = 0; k < 2; ++k)
      for (const auto& [body, G] : {std::pair{at.a, joint_kinematics[j].GA()}, std::pair{at.b, joint_kinematics[j].GB()}}) {
        const double arm = G(k, 2);
        if (body == kGround || std::abs(arm) < std::max(1e-12, 2 * deflection)) continue;
        sum += arm * arm;
        ++count;
      }
  }
  return count > 0 ? std::sqrt(sum / count) : 1.0;
}

std::vector<JointKinematics> kinematics_at_rest(const System& system, const Vecs& q) {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> joint_kinematics;
  system.motions(q, Vecs(q.size(), S::Vec::Zero()), m);
  system.joint_kinematics(0, m, joint_kinematics);
  return joint_kinematics;
}

}  // namespace pintle
