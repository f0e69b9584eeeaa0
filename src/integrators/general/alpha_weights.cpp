#include "integrators/general/alpha_weights.h"

#include <cmath>

namespace pintle {

// theory/solvers Eq. (3.6).
double AlphaWeights::velocity_error() const {
  const double g = gamma(), d = lag(), ahead = 1 + d;
  const double offset = 0.5 * (1 - forces - (1 - accelerations) * ahead * ahead - accelerations * d * d);
  return 0.5 * (1 - g) * d * d + 0.5 * g * ahead * ahead + offset - 1.0 / 6;
}

std::array<double, 2> AlphaWeights::local_errors(double h, double h_before, const Ends& x) const {
  const double slope_v = (x.v_end - x.v_begin) / h, slope_a = (x.a_end - x.a_begin) / h;
  double q3 = slope_a, v3 = slope_a / h;  // a first step has nothing better: an overestimate
  if (h_before > 0) {
    q3 = 2 * (slope_v - (x.v_begin - x.v_before) / h_before) / (h + h_before);
    v3 = 2 * (slope_a - (x.a_begin - x.a_before) / h_before) / (h + h_before);
  }
  return {std::abs(position_error()) * h * h * h * std::abs(q3), std::abs(velocity_error()) * h * h * h * std::abs(v3)};
}

}  // namespace pintle
