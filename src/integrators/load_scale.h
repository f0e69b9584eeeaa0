// The loads that relative errors refer to. theory/time section 3.5.
#pragma once

#include <algorithm>

#include "system/state.h"

namespace pintle {

/// How large the forces are that a relative tolerance refers to: per body the sum of the magnitudes of the loads on it.
template <class S>
struct BasicLoadScale {
  VecsOf<S> body;  // as forces and moments on bodies [N, N*m]
};
using LoadScale = BasicLoadScale<Planar>;

/// At least this much per mass, where nothing acts [m/s^2].
inline constexpr double kLeastLoad = 1e-9;

/// The larger of the scales of both bodies of a joint, component by component.
template <class S>
typename S::Vec load_on(const BasicPlacement<S>& at, const BasicLoadScale<S>& scale) {
  return scale.body[at.a == kGround ? at.b : at.a].cwiseMax(scale.body[at.b == kGround ? at.a : at.b]);
}

/// What the force of a joint with states is measured by: the loads on its bodies, and for a couple that its law makes of its force
/// the smaller of these loads at the lever: no more than that can press.
template <class S>
typename S::Vec load_on(const BasicJointData<S>& joint, const BasicLoadScale<S>& scale) {
  typename S::Vec load = load_on(joint.at, scale);
  const double lever = joint.law.lever();
  if (!(lever > 0)) return load;
  const typename S::Vec &first = scale.body[joint.at.a == kGround ? joint.at.b : joint.at.a], &second = scale.body[joint.at.b == kGround ? joint.at.a : joint.at.b];
  for (int k = S::kDim; k < S::kDof; ++k) load[k] = std::min(load[k], lever * std::min(first[0], second[0]));
  return load;
}

/// Raises a body's scale to the sum of the magnitudes of what acts on it.
template <class S>
void raise_scale(const BasicBodyData<S>& body, const typename S::Vec& load, typename S::Vec& scale) {
  const double radius = body.radius_of_gyration();
  const double force = std::max({scale[0], load.template head<S::kDim>().maxCoeff(), kLeastLoad * body.mass[0]});
  const double moment = std::max(scale[S::kDim], load.template tail<S::kDof - S::kDim>().maxCoeff());
  scale.template head<S::kDim>().setConstant(std::max(force, 1e-3 * moment / radius));
  scale.template tail<S::kDof - S::kDim>().setConstant(std::max(moment, 1e-3 * scale[0] * radius));
}

/// Raises `scale` to what acts on each body of `state`: m are the motions there, Q the external forces.
template <class S>
void grow_load_scale(const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const VecsOf<S>& Q, const BasicState<S>& state, BasicLoadScale<S>& scale);

}  // namespace pintle
