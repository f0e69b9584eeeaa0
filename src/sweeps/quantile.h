// Quantiles: map a number between 0 and 1 to a value from a distribution.
#pragma once

#include "io/variations.h"

namespace pintle {

/// Inverse of the standard normal distribution function for 0 < p < 1, accurate to roundoff (Wichura's algorithm AS 241).
double normal_quantile(double p);

/// The value below which the fraction `u` of the truncated distribution lies; 0 < u < 1.
double quantile(const Variation& variation, double u);

}  // namespace pintle
