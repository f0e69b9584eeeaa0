// Angles in radians, and the standard acceleration of free fall.
#pragma once

#include <numbers>

namespace pintle {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTurn = 2 * kPi;
inline constexpr double kDegree = kPi / 180;
/// Third General Conference on Weights and Measures (1901) [m/s^2].
inline constexpr double kStandardGravity = 9.80665;

}  // namespace pintle
