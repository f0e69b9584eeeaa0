// Thresholds that several methods, and what judges them, have in common.
#pragma once

#include <cmath>
#include <limits>

namespace pintle {

/// What rounding may make of a number that is computed from others, over the largest of these.
inline constexpr double kLastBits = 16 * std::numeric_limits<double>::epsilon();

/// Where a step of h from `begin` ends: at t_end where only rounding is between them.
inline double end_of_step(double begin, double h, double t_end) { return t_end - begin - h < kLastBits * std::abs(t_end) ? t_end : begin + h; }

/// Of the run: the shortest step that is refused for its error. No step resolves a force that jumps; one that is this short passes over the jump. Halved or
/// doubled it changes no run of theory/constants: it has to lie between the last bits and the steps that a motion takes.
inline constexpr double kShortestRefused = 1e-11;

/// A joint is measured at least by this part of the mechanism's largest force. theory/time Eq. (6.1).
inline constexpr double kNegligible = 1e-4;

/// Of the usual step that is kept in mind, by each step that is shorter: one in which something is met does not make steps short.
inline constexpr double kForget = 0.99;

}  // namespace pintle
