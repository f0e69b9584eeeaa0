// What the plane and space have in common: everything from the joints' kinematics upwards is written for a space S that satisfies this concept.
#pragma once

#include <concepts>
#include <vector>

#include "space/planar_lanes.h"
#include "space/planar_joint_jacobian.h"
#include "space/planar_pose.h"
#include "space/spatial.h"
#include "space/spatial_lanes.h"
#include "space/spatial_pose.h"

namespace pintle {

/// Coordinates and increments of a body, velocities and wrenches, frames, and the relative pose of two frames with its Jacobians,
/// convective terms and geometric stiffness. Nothing outside this directory knows the number of coordinates.
template <class S>
concept Space = requires(typename S::Coordinates q, const typename S::Vec dq, typename S::Motion m, typename S::Frame F, typename S::RelativePose pose, typename S::Vec z) {
  { S::kDof } -> std::convertible_to<int>;
  { S::kDim } -> std::convertible_to<int>;
  S::move(q, dq);
  { S::moved(q, dq) } -> std::convertible_to<typename S::Coordinates>;
  { S::difference(q, q) } -> std::convertible_to<typename S::Vec>;
  { S::rate_of_increment(dq, dq) } -> std::convertible_to<typename S::Vec>;
  { S::Motion::of(q, dq) } -> std::convertible_to<typename S::Motion>;
  { S::RelativePose::between(m, F, m, F) } -> std::convertible_to<typename S::RelativePose>;
  { pose.z } -> std::convertible_to<typename S::Vec>;
  { pose.rate } -> std::convertible_to<typename S::Vec>;
  { pose.bias } -> std::convertible_to<typename S::Vec>;
  { pose.GA() } -> std::convertible_to<typename S::Mat>;
  { pose.geometric(dq) } -> std::convertible_to<Eigen::Matrix<double, 2 * S::kDof, 2 * S::kDof>>;
  { pose.rate_gradient(m, m) } -> std::convertible_to<Eigen::Matrix<double, S::kDof, 2 * S::kDof>>;
  S::count_turns(dq, z);
};

static_assert(Space<Planar> && Space<Spatial>);

// Short names of the plane's types, for code that knows no other space.
template <class T>
using PoseGeometry = PlanarPoseGeometry<T>;
template <class T>
using GapMap = PlanarGapMap<T>;
using RelativePose = PlanarRelativePose;

}  // namespace pintle
