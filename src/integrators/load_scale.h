// The loads that relative errors refer to. theory/time section 3.5.
#pragma once

#include <algorithm>

#include "system/state.h"

namespace pintle {

/// How large the forces are that a relative tolerance refers to: per body the sum of the magnitudes of the loads on it.
struct LoadScale {
  Vecs body;  // [N, N, N*m]
};

/// At least this much per mass, where nothing acts [m/s^2].
inline constexpr double kLeastLoad = 1e-9;

/// The larger of the scales of both bodies of a joint, component by component.
inline Planar::Vec load_on(const Placement& at, const LoadScale& scale) {
  return scale.body[at.a == kGround ? at.b : at.a].cwiseMax(scale.body[at.b == kGround ? at.a : at.b]);
}

/// What the force of a joint with states is measured by: the loads on its bodies, and for a couple that its law makes of its force
/// the smaller of these loads at the lever: no more than that can press.
inline Planar::Vec load_on(const JointData& joint, const LoadScale& scale) {
  Planar::Vec load = load_on(joint.at, scale);
  const double lever = joint.law.lever();
  if (!(lever > 0)) return load;
  const Planar::Vec &first = scale.body[joint.at.a == kGround ? joint.at.b : joint.at.a], &second = scale.body[joint.at.b == kGround ? joint.at.a : joint.at.b];
  load[2] = std::min(load[2], lever * std::min(first[0], second[0]));
  return load;
}

/// Raises a body's scale to the sum of the magnitudes of what acts on it.
inline void raise_scale(const BodyData& body, const Planar::Vec& load, Planar::Vec& scale) {
  const double radius = body.radius_of_gyration();
  const double force = std::max({scale[0], load[0], load[1], kLeastLoad * body.mass[0]}), moment = std::max(scale[2], load[2]);
  scale[0] = scale[1] = std::max(force, 1e-3 * moment / radius);
  scale[2] = std::max(moment, 1e-3 * scale[0] * radius);
}

/// Raises `scale` to what acts on each body of `state`: m are the motions there, Q the external forces.
void grow_load_scale(const System& system, const std::vector<Planar::Motion>& m, const Vecs& Q, const State& state, LoadScale& scale);

}  // namespace pintle
