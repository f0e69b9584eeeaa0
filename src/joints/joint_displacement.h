// The displacement of a joint, its gap: what an ideal joint would forbid, with its rate, Jacobians and convective term.
#pragma once

#include <cmath>
#include <type_traits>
#include <variant>

#include "joints/gap_function.h"

namespace pintle {

/// Joints whose gap is z itself minus an offset; the law has no stiffness in the free components.
template <class S>
struct BasicSelection {
  typename S::Vec offset = S::Vec::Zero();  // e.g. full turns of a weld's angle

  static int gap_functions() { return 0; }
};

using Selection = BasicSelection<Planar>;

/// The kinds of gaps in a space.
template <class S>
struct DisplacementsOf;
template <>
struct DisplacementsOf<Planar> {
  using Type = std::variant<Selection, Distance, Mesh, RackMesh, FunctionGap, CamGap, EdgeGap>;
};
template <>
struct DisplacementsOf<Spatial> {
  using Type = std::variant<BasicSelection<Spatial>, BasicDistance<Spatial>>;
};
template <class S>
using BasicDisplacement = typename DisplacementsOf<S>::Type;
using JointDisplacement = BasicDisplacement<Planar>;

/// The gap between two bodies in the form laws use; functions of the pose come first.
///   rate = GA vA + GB vB,   gap'' = GA aA + GB aB + bias
template <class S>
struct BasicJointKinematics {
  typename S::Vec gap, rate, bias;
  typename S::template GapMap<double> map;

  typename S::Mat GA() const { return map.GA(); }
  typename S::Mat GB() const { return map.GB(); }
};
using JointKinematics = BasicJointKinematics<Planar>;

template <class S>
BasicJointKinematics<S> read(const BasicSelection<S>& displacement, const typename S::RelativePose& pose) {
  return {pose.z - displacement.offset, pose.rate, pose.bias, S::template GapMap<double>::of(pose)};
}

/// The functions of displacements, by their space S.
template <class S>
struct DisplacementReader {
  using Vec = typename S::Vec;
  using Pose = typename S::RelativePose;
  using Displacement = BasicDisplacement<S>;
  using Both = Eigen::Matrix<double, 2 * S::kDof, 2 * S::kDof>;
  using RateGradient = Eigen::Matrix<double, S::kDof, 2 * S::kDof>;

  static BasicJointKinematics<S> read(const Displacement& displacement, const Pose& pose);
  static Vec to_pose_force(const Displacement& displacement, const Pose& pose, const Vec& force);
  static Both geometric_stiffness(const Displacement& displacement, const Pose& pose, const Vec& force);
  static RateGradient rate_gradient(const Displacement& displacement, const Pose& pose, const typename S::Motion& A, const typename S::Motion& B);
};
/// How many components of the gap are functions of the pose; 0: it is the pose itself.
template <class Displacement>
int count_functions(const Displacement& displacement) {
  return std::visit(
      [](const auto& p) {
        if constexpr (requires { p.gap_functions(); }) return p.gap_functions();
        else return 1;
      },
      displacement);
}

/// Of the values of a gap that the pose determines only up to whole turns, takes the one nearest to `carried`, which a method has followed step by step.
template <class Displacement, class Gap>
void count_turns(const Displacement& displacement, double carried, Gap&& gap) {
  std::visit(
      [&](const auto& p) {
        if constexpr (requires { p.period; })
          if (p.period > 0) gap[0] -= p.period * std::round((gap[0] - carried) / p.period);
      },
      displacement);
}

/// The component of the slip, in displacements that have one: its rate is a speed along the surfaces, and its gap is not a function of the pose but is carried.
constexpr int kSlip = 1;
template <class Displacement>
bool has_slip(const Displacement& displacement) {
  return std::visit([](const auto& p) { return requires(const Planar::Vec& z) { p.gap_and_slip(z); }; }, displacement);
}

/// Makes the turn of gears relative to each other, or of a pinion relative to its rack, component 2 of the gap, for the friction of their teeth.
inline void let_teeth_rub(JointDisplacement& displacement) {
  if (auto* gears = std::get_if<Mesh>(&displacement)) gears->rubs = true;
  if (auto* rack = std::get_if<RackMesh>(&displacement)) rack->rubs = true;
}

/// Calls use(component, function) for every component of the gap that is a function of the pose z.
template <class Displacement, class Vec, class Use>
void for_each_function(const Displacement& displacement, const Vec& z, Use&& use) {
  std::visit(
      [&](const auto& p) {
        if constexpr (!requires { p.offset; }) visit_functions(p, z, use);
      },
      displacement);
}

/// The space of a relative pose.
template <class Pose>
using SpaceOf = typename Pose::S;

/// The displacement at a relative pose, with its rate, map and bias.
template <class Displacement, class Pose>
auto read(const Displacement& displacement, const Pose& pose) { return DisplacementReader<SpaceOf<Pose>>::read(displacement, pose); }

/// The law's force in the components of z: J' f.
template <class Displacement, class Pose, class Vec>
auto to_pose_force(const Displacement& displacement, const Pose& pose, const Vec& force) {
  return DisplacementReader<SpaceOf<Pose>>::to_pose_force(displacement, pose, force);
}

/// d(G' f)/dq at constant f over (qA, qB): the geometric stiffness of the joint.
template <class Displacement, class Pose, class Vec>
auto geometric_stiffness(const Displacement& displacement, const Pose& pose, const Vec& force) {
  return DisplacementReader<SpaceOf<Pose>>::geometric_stiffness(displacement, pose, force);
}

/// d(rate)/dq over (qA, qB).
template <class Displacement, class Pose, class Motion>
auto rate_gradient(const Displacement& displacement, const Pose& pose, const Motion& A, const Motion& B) {
  return DisplacementReader<SpaceOf<Pose>>::rate_gradient(displacement, pose, A, B);
}

/// d(bias)/dq over (qA, qB) at constant velocities, in the plane. If the gap is a function of the pose, the function's third derivative is left out.
Eigen::Matrix<double, 3, 6> bias_gradient(const JointDisplacement& displacement, const RelativePose& pose, const Planar::Motion& A, const Planar::Motion& B);

}  // namespace pintle
