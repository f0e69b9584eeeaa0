// The explicit pair of order 5(4) with seven stages, the last at the step's end. J. R. Dormand and P. J. Prince, J. Comput.
// Appl. Math. 6 (1980) 19-26.
#pragma once

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle::dormand_prince {

constexpr int kStages = 7;
constexpr double kA[kStages][6] = {{},
                                   {1.0 / 5},
                                   {3.0 / 40, 9.0 / 40},
                                   {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                   {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                   {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                   {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
constexpr double kC[kStages] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
/// The weights of the fifth order minus those of the fourth.
constexpr double kE[kStages] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/// Whether a step of h with an embedded error of this many tolerances is accepted, in a run up to t_end.
inline bool is_accepted(double error, double h, double t_end) { return error <= 1 || (std::isfinite(error) && h <= kShortestRefused * std::abs(t_end)); }

/// The ratio of the next step to this one, whose embedded error was this many tolerances: the error falls with the fifth power of the step.
inline double step_ratio(double error) {
  constexpr double kSafety = 0.9;                  // fraction of the step that the error would allow. Hairer, Norsett, Wanner I, II.4
  constexpr double kLeast = 0.2, kMost = 5;        // smallest ratio; largest ratio
  constexpr double kWithoutError = 0.1;            // ratio where the error is not finite
  return std::isfinite(error) ? std::clamp(kSafety * std::pow(error, -0.2), kLeast, kMost) : kWithoutError;
}

}  // namespace pintle::dormand_prince
