// What the error estimates of all Radau steps have in common. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

/// mu of the projection over the step's own frequency: every mode that a step does not resolve to the full is moved onto its gap.
constexpr double kProjectionShare = 0.01;
/// Error of a gap's acceleration over its last coefficient.
constexpr double kGapError = 3;
/// Error of the joints' forces over the last coefficient of what laws with states add to the loads on bodies. theory/time Eq. (3.18).
constexpr double kStateError = 30;

/// Error of the bodies' places over what moves them onto their gaps. theory/time Eq. (3.20).
constexpr double kPlaceError = 10;

/// What the next coefficients of a series will be like: its last ones fall off by this ratio, at most 1.
inline double fall_off(double last, double before, double before_that) {
  return std::min(1.0, std::max(last / before, std::sqrt(last / before_that)));
}

/// The size of the last of three coefficients, with what the next one will be like. Infinite where one of them is no finite number.
inline double tail_size(double last, double before, double before_that) {
  if (!std::isfinite(last + before + before_that)) return std::numeric_limits<double>::infinity();
  return last > 0 ? last * fall_off(last, before, before_that) : 0;
}

}  // namespace pintle
