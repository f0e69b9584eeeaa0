// The loads that relative errors refer to. theory/time section 3.5.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "system/state.h"

namespace pintle {

/// The size of the forces to which a relative tolerance refers: per body the sum of the magnitudes of the loads on it.
template <class S>
struct BasicLoadScale {
  VecsOf<S> body;  // as forces and moments on bodies [N, N*m]
};
using LoadScale = BasicLoadScale<Planar>;

/// Lower limit of loads per mass, where nothing acts [m/s^2].
inline constexpr double kLeastLoad = 1e-9;
/// Lower limit on a body's moment scale, as a fraction of its force scale at its radius of gyration; and on its force scale, as a fraction of its
/// moment scale over that radius.
inline constexpr double kCoupleAtArm = 1e-3;

/// The load [N] below which the rounding of coordinates of a size [m], as force of a joint of a stiffness [N/m], exceeds the tolerance.
inline double load_above_rounding(double stiffness, double size, double tolerance) {
  constexpr double kRoundings = 30;  // rounding of a gap, in roundings of a coordinate
  return kRoundings * std::numeric_limits<double>::epsilon() * size * stiffness / tolerance;
}

/// Rounding of gaps that are computed from the positions of bodies [m, rad]: that of angles, which count turns; and that of coordinates, or of angles at an arm as
/// long as the largest of them. A carried gap that differs by less is the more accurate of the two.
template <class S>
typename S::Vec rounding_of_gaps(const PositionsOf<S>& q);

/// The larger of the scales of both bodies of a joint, component by component.
template <class S>
typename S::Vec load_on(const BasicPlacement<S>& at, const BasicLoadScale<S>& scale) {
  return scale.body[at.a == kGround ? at.b : at.a].cwiseMax(scale.body[at.b == kGround ? at.a : at.b]);
}

/// The same in the axes of a gap, which differ from those of the loads.
template <class S>
typename S::Vec load_in_gap_axes(const BasicPlacement<S>& at, const BasicLoadScale<S>& scale) {
  typename S::Vec load = load_on(at, scale);
  load.template head<S::kDim>().setConstant(load.template head<S::kDim>().maxCoeff());
  return load;
}

/// The loads by which the force of a joint with states is measured: those on its bodies, and for a couple that its law makes of
/// its force the smaller of these loads at the lever, since no larger force can press there.
template <class S>
typename S::Vec load_on(const BasicJointData<S>& joint, const BasicLoadScale<S>& scale) {
  typename S::Vec load = load_on(joint.at, scale);
  const double lever = joint.law.lever();
  if (!(lever > 0)) return load;
  const typename S::Vec &first = scale.body[joint.at.a == kGround ? joint.at.b : joint.at.a], &second = scale.body[joint.at.b == kGround ? joint.at.a : joint.at.b];
  for (int k = S::kDim; k < S::kDof; ++k) load[k] = std::min(load[k], lever * std::min(first[0], second[0]));
  return load;
}

/// The largest force over the loads, from the accelerations of all bodies. Infinite where one is not finite.
template <class S>
double over_loads(const BasicSystem<S>& system, const VecsOf<S>& accelerations, const BasicLoadScale<S>& scale) {
  double size = 0;
  for (int i = 0; i < system.n_bodies(); ++i) {
    if (!accelerations[i].allFinite()) return std::numeric_limits<double>::infinity();
    size = std::max(size, accelerations[i].cwiseProduct(system.bodies[i].mass).cwiseQuotient(scale.body[i]).cwiseAbs().maxCoeff());
  }
  return size;
}
/// The same for accelerations in a single vector.
template <class S>
double over_loads(const BasicSystem<S>& system, const Eigen::VectorXd& accelerations, const BasicLoadScale<S>& scale) {
  if (!accelerations.allFinite()) return std::numeric_limits<double>::infinity();
  double size = 0;
  for (int i = 0; i < system.n_bodies(); ++i)
    size = std::max(size, accelerations.template segment<S::kDof>(S::kDof * i).cwiseProduct(system.bodies[i].mass).cwiseQuotient(scale.body[i]).cwiseAbs().maxCoeff());
  return size;
}

/// Raises a body's scale to the sum of the magnitudes of the loads on it.
template <class S>
void raise_scale(const BasicBodyData<S>& body, const typename S::Vec& load, typename S::Vec& scale) {
  const double radius = body.radius_of_gyration();
  const double force = std::max({scale[0], load.template head<S::kDim>().maxCoeff(), kLeastLoad * body.mass[0]});
  const double moment = std::max(scale[S::kDim], load.template tail<S::kDof - S::kDim>().maxCoeff());
  scale.template head<S::kDim>().setConstant(std::max(force, kCoupleAtArm * moment / radius));
  scale.template tail<S::kDof - S::kDim>().setConstant(std::max(moment, kCoupleAtArm * scale[0] * radius));
}

/// Raises `scale` to the loads on each body of `state`: m are the motions there, Q the external forces. `load` is reused storage.
template <class S>
void grow_load_scale(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const VecsOf<S>& Q, const BasicState<S>& state, BasicLoadScale<S>& scale, VecsOf<S>& load);
template <class S>
void grow_load_scale(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const VecsOf<S>& Q, const BasicState<S>& state, BasicLoadScale<S>& scale) {
  VecsOf<S> load;
  grow_load_scale(system, m, Q, state, scale, load);
}

/// For each body: the load below which the rounding of positions, as force of these joints at `state`, would be an error above the tolerance [N].
template <class S>
std::vector<double> loads_above_rounding(const BasicSystem<S>& system, const std::vector<int>& joints, const BasicState<S>& state, double tolerance);

/// The largest effect of the rounding of positions and angles on the forces of joints, and their moments at the mechanism's arms, on each body [N, N*m].
template <class S>
void find_rounding_of_joint_forces(const BasicSystem<S>& system, const PositionsOf<S>& q, VecsOf<S>& rounding);

/// Whether the loads at the motions m change within a time d by no more than `most` of the scale. `now` and `then` are reused storage.
template <class S>
bool loads_stay_constant(const BasicSystem<S>& system, double t, double d, const std::vector<typename S::Motion>& m, SlidingModes sliding, double most, const BasicLoadScale<S>& scale, VecsOf<S>& now,
                         VecsOf<S>& then) {
  if (!system.has_loads()) return true;
  now.assign(system.bodies.size(), S::Vec::Zero());
  then.assign(system.bodies.size(), S::Vec::Zero());
  system.external(t, m, now, sliding);
  system.external(t + d, m, then, sliding);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (!((then[i] - now[i]).cwiseAbs().cwiseQuotient(scale.body[i]).maxCoeff() <= most)) return false;
  return true;
}

/// Raises the forces of the scale to these loads.
template <class S>
void raise_above(const std::vector<double>& loads, BasicLoadScale<S>& scale) {
  for (std::size_t i = 0; i < loads.size(); ++i) scale.body[i].template head<S::kDim>() = scale.body[i].template head<S::kDim>().cwiseMax(loads[i]);
}

}  // namespace pintle
