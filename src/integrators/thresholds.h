// Thresholds shared by several methods, and by what judges them.
#pragma once

#include <cmath>
#include <limits>

namespace pintle {

/// Largest rounding error of a number that is computed from others, relative to the largest of these.
inline constexpr double kLastBits = 16 * std::numeric_limits<double>::epsilon();

/// The end of a step of h from `begin`: t_end where only rounding is between them.
inline double end_of_step(double begin, double h, double t_end) { return t_end - begin - h < kLastBits * std::abs(t_end) ? t_end : begin + h; }

/// Fraction of the run: the shortest step that is rejected for its error. No step resolves a force that jumps; one that is this short passes over the jump.
/// Halved or doubled it changes no run of theory/constants: it has to lie between the last bits and the steps that a motion takes.
inline constexpr double kShortestRefused = 1e-11;

/// Lower limit on the force by which a joint is measured, as a fraction of the mechanism's largest force. theory/time Eq. (6.1).
inline constexpr double kNegligible = 1e-4;

/// Factor by which each shorter step reduces the usual step that is remembered: a step in which something is met does not make the next ones short.
inline constexpr double kForget = 0.99;

}  // namespace pintle
