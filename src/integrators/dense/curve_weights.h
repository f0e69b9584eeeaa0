// Values at x of the powers of the share x of a step, whose coefficients give an acceleration or a rate. theory/time Eq. (5.1).
#pragma once

#include <array>

#include "base/cubic_hermite.h"
#include "integrators/dense/force_samples.h"

namespace pintle {

struct CurveWeights {
  static constexpr int kMost = ForceSamples::kAll;
  static_assert(kMost >= RadauTable::kMaxNodes);
  std::array<double, kMost> value, first, second;  // weights of the coefficients: for the value, and its first and second integrals over time from the start of the step
  double end_mismatch_weight;                      // of what the second integral misses at the far end; the first takes x of it

  /// At the share x of a step of h seconds.
  CurveWeights(double x, double h) : end_mismatch_weight(cubic_blend(x)) {
    double power = 1;
    for (int k = 0; k < kMost; ++k, power *= x) {
      value[k] = power;
      first[k] = h * power * x / (k + 1);
      second[k] = first[k] * h * x / (k + 2);
    }
  }
  /// The integrals at the far end.
  static double first_integral_at_end(int k, double h) { return h / (k + 1); }
  static double second_integral_at_end(int k, double h) { return h * h / ((k + 1) * (k + 2)); }
};

}  // namespace pintle
