// Applied forces that depend on t alone, in world axes.
#pragma once

#include <array>
#include <span>

#include "system/system.h"

namespace pintle {

/// Force at the loaded point and couple, in world axes [N], [N*m].
struct PlanarWrench {
  Planar::Point force;
  double couple;
};
struct SpatialWrench {
  Spatial::Point force, couple;
};

/// Value of a constant or a function of t alone.
inline double value_at(const Expression& e, double t) {
  const std::array<double, 1> time{t};
  return e.value(std::span(time).first(e.variables().size()));
}

/// The applied force at time t on `body`, its body in motion.
inline PlanarWrench wrench(const BasicAppliedData<Planar>& load, double t, const Planar::Motion& body) {
  const Planar::Point f(value_at(load.fx, t), value_at(load.fy, t));
  return {load.body_axes ? body.turned(f) : f, value_at(load.torque, t)};
}
inline SpatialWrench wrench(const BasicAppliedData<Spatial>& load, double t, const Spatial::Motion& body) {
  Spatial::Point f, couple;
  for (int k = 0; k < 3; ++k) {
    f[k] = value_at(load.force[k], t);
    couple[k] = value_at(load.torque[k], t);
  }
  return load.body_axes ? SpatialWrench{body.turned(f), body.turned(couple)} : SpatialWrench{f, couple};
}

}  // namespace pintle
