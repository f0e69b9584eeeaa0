// The four-bar of section 8 beside ideal joints.
#pragma once

#include <array>

#include "paper/ideal.h"
#include "paper/runs.h"

namespace pintle::paper {

/// One turn from crank angle `degrees`, c and k of every pin; rows at each degree of crank.
Model four_bar(const Bearing& bearing, double degrees);

/// Largest differences from ideal joints at the same crank angle, each pin's over its own ideal peak.
struct FromIdeal {
  double force = 0;                ///< worst pin
  std::array<double, 4> by_pin{};  ///< O2, A, B, O4
  double angle = 0;                ///< of coupler and follower [rad]
  double speed = 0;                ///< of coupler and follower [rad/s]
};
/// Rows after `from` seconds; the ideal motion starts at crank angle `degrees` with 10 rad/s.
FromIdeal from_ideal(const Trajectory& run, double degrees, double from = 0);

/// Worst pin's force error at one row, over its ideal peak.
double force_error(const Trajectory& run, std::size_t row, double degrees);

/// Largest ideal force of each pin over a turn [N].
const std::array<double, 4>& ideal_peaks();

}  // namespace pintle::paper
