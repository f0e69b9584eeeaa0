// The tolerance as used by a general integrator. theory/solvers Eq. (1.4).
#pragma once

namespace pintle {

/// The error of a component y of q or v may be relative * |y| + absolute; with the ratio of MATLAB's defaults.
struct UsualTolerance {
  double relative, absolute;  // [-]; [m, rad, m/s, rad/s]
  explicit UsualTolerance(double tolerance) : relative(tolerance), absolute(1e-3 * tolerance) {}
};

}  // namespace pintle
