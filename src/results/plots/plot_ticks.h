// Positions of an axis's ticks, and how its numbers are printed.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// A range with ticks at multiples of 1, 2 or 5 times a power of ten. On a logarithmic axis (`log`) low, high, step and ticks
/// are exponents of ten.
struct Axis {
  double low = 0, high = 1, step = 1;
  bool log = false;

  std::vector<double> ticks() const;           ///< those within [low, high]
  double share(double value) const;            ///< position of a value, from 0 at low to 1 at high; NaN: not on the axis
  std::string label(double tick) const;        ///< printed form of a tick
};

/// The nearest of 1, 2, 5, 10 times a power of ten, for x > 0.
double round_step(double x);

/// The axis for data in [low, high] with about `n_ticks` ticks. `tight`: ends where the data end; otherwise with a margin,
/// but not beyond zero if the data almost reach it. A range of zero width is widened.
Axis make_axis(double low, double high, int n_ticks, bool tight);

/// Whole decades around positive data in [low, high], with at most n_ticks + 1 ticks.
Axis make_log_axis(double low, double high, int n_ticks);

/// Divisor that keeps an axis's numbers short; the name of the unit then gets the prefix.
struct AxisScale {
  double factor = 1;
  std::string unit;  ///< "kN", "10^6 rad/s"
};

/// `largest` is the largest magnitude on the axis, in `unit`.
AxisScale scale_for(double largest, const std::string& unit);

/// Tick label with as many decimals as the step needs, with a proper minus sign.
std::string tick_text(double value, double step);

/// "1.4e-06" in print: "1.4·10⁻⁶"; "1e-05": "10⁻⁵".
std::string printed_number(const std::string& number);

/// "N*m/s^2" in print: "N·m/s²".
std::string printed_unit(const std::string& unit);

}  // namespace pintle
