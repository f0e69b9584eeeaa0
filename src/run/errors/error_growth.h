// Whether the difference of two passes grows exponentially along the motion, as errors do where it is chaotic. theory/time section 6.1.
#pragma once

#include "run/errors/stated_error.h"

namespace pintle {

/// e(t) = level exp(rate (t - until)) fitted to the difference of two passes until it is as large as it can become.
struct ErrorGrowth {
  bool exponential = false;  ///< the curve is long enough, straight in its logarithm, and not a power of time
  bool saturated = false;    ///< the difference became as large as it can
  double rate = 0;           ///< [1/s]
  double rate_error = 0;     ///< the standard error of the line's slope [1/s]
  double rate_scatter = 0;   ///< by how much it would differ over another stretch as long: one standard deviation [1/s]
  double until = 0;          ///< end of the fitted part [s]
  double level = 0;          ///< of the fitted line there [-]
  bool to_largest = false;   ///< fitted to the largest difference: it tells whether the motion is chaotic, but not which tolerance would do

  /// What the difference would be at time t [s] if it went on growing at `with_rate` [1/s].
  double extrapolated(double t, double with_rate) const;
};

/// Of differences of forces, or of places, over what they can become: those above a few hundredths no longer grow as small ones do.
/// theory/time Eqs. (6.5)-(6.7).
ErrorGrowth fit_growth(const DifferenceCurve& curve);
/// Of differences of places that stay small beside the longest way, as those of a pin in a bush: what they become is the largest of them. The line's
/// level is meaningless. theory/time Eqs. (6.5)-(6.7).
ErrorGrowth fit_growth_to_largest(const DifferenceCurve& curve);

/// Whether two fits, of pairs of passes with different tolerances, show the same growth: a smaller tolerance then shifts the curve along
/// the time by a fixed amount. Of a power of time it would stretch it. theory/time Eq. (6.8).
bool same_growth(const ErrorGrowth& first, const ErrorGrowth& second);

}  // namespace pintle
