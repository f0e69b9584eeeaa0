// What the error estimates of all Radau steps have in common. theory/time section 3.4.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/radau/radau_table.h"

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

/// What the quadrature at the stages misses of the work of a servo whose effort at the stages and speed at the nodes are these: both may be polynomials that one long step
/// follows exactly, and their product one of a higher degree [J]. theory/time Eq. (3.22).
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
  effort[0] = table.weights_of_last(table.n, 0).dot(effort);  // where a step begins behind a jump, or damps what rings, the force there is not on the curve of the stages
  return h * (table.integral_of_product(effort, speed) - by_quadrature);
}

}  // namespace pintle
