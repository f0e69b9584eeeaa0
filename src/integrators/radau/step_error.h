// What the error estimates of all Radau steps share. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/radau/radau_table.h"

namespace pintle {

/// mu of the projection, as a fraction of the step's own frequency: every mode that a step does not fully resolve is moved onto its gap.
constexpr double kProjectionShare = 0.01;
/// Error of a gap's acceleration, as a multiple of its last coefficient.
constexpr double kGapError = 3;
/// Error of joint forces, as a multiple of the last coefficient of what laws with states add to the loads on bodies. theory/time Eq. (3.18).
constexpr double kStateError = 30;

/// Error of the bodies' positions, as a multiple of the displacement onto their gaps. theory/time Eq. (3.20).
constexpr double kPlaceError = 10;

/// Expected ratio of the next coefficient of a series to the last: the ratio at which the last ones decrease, at most 1.
inline double fall_off(double last, double before, double before_that) {
  return std::min(1.0, std::max(last / before, std::sqrt(last / before_that)));
}

/// Size of the last of three coefficients, times the expected ratio of the next one to it. Infinite if one of them is not finite.
inline double tail_size(double last, double before, double before_that) {
  if (!std::isfinite(last + before + before_that)) return std::numeric_limits<double>::infinity();
  return last > 0 ? last * fall_off(last, before, before_that) : 0;
}

/// The part of a servo's work that quadrature at the stages misses [J], from its effort at the stages and its speed at the nodes: both may be polynomials that one long
/// step follows exactly, while their product has a higher degree. theory/time Eq. (3.22).
template <class Effort, class Speed>
double work_missed_by_quadrature(const RadauTable& table, double h, Effort&& effort_at, Speed&& speed_at) {
  RadauTable::Vec effort(table.n + 1), speed(table.n + 1);
  double by_quadrature = 0;
  effort[0] = 0;
  speed[0] = speed_at(0);
  for (int node = 1; node <= table.n; ++node) {
    effort[node] = effort_at(node);
    speed[node] = speed_at(node);
    by_quadrature += table.b[node - 1] * effort[node] * speed[node];
  }
  effort[0] = table.weights_of_last(table.n, 0).dot(effort);  // where a step begins after a jump, or damps ringing, the force at its start is not on the curve of the stages
  return h * (table.integral_of_product(effort, speed) - by_quadrature);
}

}  // namespace pintle
