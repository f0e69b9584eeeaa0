// The response of a law: the force on the second body, its tangents, the stored energy and the lost power.
#pragma once

#include "space/space.h"

namespace pintle {

/// Gap, rate and force have one entry per z-component (x, y, angle of M in F); a component that a joint leaves free has
/// zero stiffness, damping and force.
template <class S>
struct BasicResponse {
  typename S::Vec force = S::Vec::Zero();      // on the second body, conjugate to the gap [N, N, N*m]
  typename S::Mat stiffness = S::Mat::Zero();  // -d(force)/d(gap)
  typename S::Mat damping = S::Mat::Zero();    // -d(force)/d(rate)
  double energy = 0;                  // V, with the elastic part of the force = -dV/d(gap) [J]
  double loss = 0;                    // power turned into heat, >= 0 [W]
};
using Response = BasicResponse<Planar>;

}  // namespace pintle
