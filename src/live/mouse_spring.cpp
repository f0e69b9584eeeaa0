#include "live/mouse_spring.h"

#include <algorithm>

namespace pintle {
namespace {

using S = Planar;

}  // namespace

JointData mouse_spring(const std::string& name, int body, const Vec2& point, double k) {
  JointData joint;
  joint.name = name;
  joint.type = "revolute";
  joint.at.b = body;
  joint.at.M = S::Frame::at({point[0], point[1]}, 0);
  joint.law = LinearLaw{{k, k, 0}, {0, 0, 0}};
  joint.free_mask[2] = 1;
  return joint;
}

S::Point in_world(const S::Vec& q, const Vec2& point) {
  const S::Motion body = S::Motion::of(q, S::Vec::Zero());
  return body.p + body.turned({point[0], point[1]});
}

double largest_stiffness(const System& system) {
  double largest = 0;
  for (const JointData& joint : system.joints)
    largest = std::max(largest, joint.law.engaged_stiffness().head<2>().maxCoeff());
  return largest;
}

std::vector<PlanarPose> rows(const Vecs& x) {
  std::vector<PlanarPose> out;
  out.reserve(x.size());
  for (const auto& row : x) out.push_back({row[0], row[1], row[2]});
  return out;
}

}  // namespace pintle
