// Tests whether the difference of two passes grows exponentially in time, as errors of a chaotic motion do. theory/time section 6.1.
#pragma once

#include "run/errors/stated_error.h"

namespace pintle {

/// e(t) = level exp(rate (t - until)) fitted to the difference of two passes up to its saturation.
struct ErrorGrowth {
  bool exponential = false;  ///< the curve is long enough, straight in its logarithm, and not a power of time
  bool saturated = false;    ///< the difference became as large as it can be
  double rate = 0;           ///< [1/s]
  double rate_error = 0;     ///< the standard error of the line's slope [1/s]
  double rate_scatter = 0;   ///< standard deviation of the rate over other intervals of the same length [1/s]
  double until = 0;          ///< end of the fitted part [s]
  double level = 0;          ///< of the fitted line there [-]
  bool to_largest = false;   ///< fitted to the largest difference: shows whether the motion is chaotic, but not which tolerance would be enough

  /// The difference at time t [s] if it continued to grow at `with_rate` [1/s].
  double extrapolated(double t, double with_rate) const;
};

/// For differences of forces or positions, relative to how large they can become: above a few hundredths they no longer grow as small ones do.
/// theory/time Eqs. (6.5)-(6.7).
ErrorGrowth fit_growth(const DifferenceCurve& curve);
/// For differences of positions that stay small compared with the longest path, as those of a pin in a bush: the largest of them is taken for
/// saturation. The line's level is meaningless. theory/time Eqs. (6.5)-(6.7).
ErrorGrowth fit_growth_to_largest(const DifferenceCurve& curve);

/// The growth of the difference of two passes; nothing if they come within `promised` of the tolerance again towards their end. Once an impact differs in time by more than its duration,
/// the forces of two passes differ there by the whole force, and by little between impacts. Differences of positions grow steadily instead: the line is fitted to these and shifted to
/// where the forces reach the tolerance. theory/time section 6.1.
template <class S>
ErrorGrowth growth_between(const BasicSystem<S>& system, const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine, bool of_motion, double tolerance, double promised);

/// Whether two fits, from pairs of passes with different tolerances, show the same growth: a smaller tolerance then shifts the curve in
/// time by a fixed amount. A power of time would be stretched instead. theory/time Eq. (6.8).
bool same_growth(const ErrorGrowth& first, const ErrorGrowth& second);

}  // namespace pintle
