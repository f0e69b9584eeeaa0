// A probe reads the gap of a joint: what an ideal joint would forbid, with its rate, Jacobians and convective term.
#pragma once

#include <type_traits>
#include <variant>

#include "probes/gap_function.h"
#include "probes/gap_map.h"
#include "probes/relative_pose.h"

namespace pintle {

/// Joints whose gap is z itself, less an offset; the law has no stiffness in the components that stay free.
struct Selection {
  Planar::Vec offset = Planar::Vec::Zero();  // e.g. full turns of a weld's angle
};

using Probe = std::variant<Selection, Distance, Mesh, RackMesh, FunctionGap>;

/// The gap between two bodies as a law wants it; scalar gaps stand in component 0.
///   rate = GA vA + GB vB,   gap'' = GA aA + GB aB + bias
struct Reading {
  Planar::Vec gap, rate, bias;
  GapMap<double> map;

  Planar::Mat GA() const { return map.GA(); }
  Planar::Mat GB() const { return map.GB(); }
};

/// Reads the probe at a relative pose.
Reading read(const Probe& probe, const RelativePose& pose);
inline Reading read(const Selection& probe, const RelativePose& pose) { return {pose.z - probe.offset, pose.rate, pose.bias, GapMap<double>::of(pose)}; }

/// The law's force as seen by z: J' f.
Planar::Vec to_pose_force(const Probe& probe, const RelativePose& pose, const Planar::Vec& force);

/// d(G' f)/dq at constant f over (qA, qB): the geometric stiffness of the joint.
Eigen::Matrix<double, 6, 6> geometric_stiffness(const Probe& probe, const RelativePose& pose, const Planar::Vec& force);

/// d(rate)/dq over (qA, qB).
Eigen::Matrix<double, 3, 6> rate_gradient(const Probe& probe, const RelativePose& pose, const Planar::Motion& A,
                                          const Planar::Motion& B);

}  // namespace pintle
