// The tolerance as used by a general integrator. theory/solvers Eq. (1.4).
#pragma once

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle {

/// The error of a component y of q or v may be relative * |y| + absolute; with the ratio of MATLAB's defaults.
struct UsualTolerance {
  double relative, absolute;  // [-]; [m, rad, m/s, rad/s]
  explicit UsualTolerance(double tolerance) : relative(tolerance), absolute(1e-3 * tolerance) {}

  /// The error allowed for a component that is a and b at the ends of a step, at least the roundoff of the `largest` component there.
  double weight(double a, double b, double largest) const {
    return relative * std::max(std::abs(a), std::abs(b)) + absolute + kLastBits * largest;
  }
};

}  // namespace pintle
