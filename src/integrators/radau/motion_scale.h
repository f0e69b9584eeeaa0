// The scale of errors for a tolerance on the motion: the force that would give a body the mechanism's speed within one
// step.
#pragma once

#include <algorithm>

#include "integrators/load_scale.h"

namespace pintle {

/// theory/time Eq. (3.15).
template <class S>
class BasicMotionScale {
 public:
  /// For a step of h from `begin`. The speed is the largest so far of a body's centre or of a point at its radius of gyration.
  void update(const BasicSystem<S>& system, const BasicState<S>& begin, double h) {
    speed_ = std::max(speed_, system.largest_speed(begin.v));
    loads_.body.resize(begin.v.size());
    for (std::size_t i = 0; i < loads_.body.size(); ++i) {
      const double radius = system.bodies[i].radius_of_gyration();
      const double force = system.bodies[i].mass[0] * std::max(speed_, kLeastSpeed) / h;
      for (int k = 0; k < S::kDof; ++k) loads_.body[i][k] = k < S::kDim ? force : force * radius;
    }
  }
  const BasicLoadScale<S>& loads() const { return loads_; }

 private:
  static constexpr double kLeastSpeed = 1e-6;  // speed by which a mechanism at rest is measured [m/s]

  double speed_ = 0;
  BasicLoadScale<S> loads_;
};

}  // namespace pintle
