// What a pin goes through: the angle that it turns in its bush, and integrals of its load over that path. theory/bearing_life section 1.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pintle {

/// One output time: angle of the pin in the bush and its rate, force on the pin in fixed axes.
struct DutyRow {
  double t = 0, angle = 0, rate = 0;  // [s], [rad], [rad/s]
  std::array<double, 2> force{};      // [N]
};

/// Between rows the angle is the cubic with the angles and rates of both, and the force goes straight.
class Duty {
 public:
  /// In the order of time.
  explicit Duty(std::vector<DutyRow> rows) : rows_(std::move(rows)) {}

  double span() const { return rows_.empty() ? 0 : rows_.back().t - rows_.front().t; }  // [s]
  /// Back and forth added up [rad]. Eq. (1.2)
  double path() const { return load_integral(0); }
  /// Integral of |F|^power over the path [N^power*rad]. Eq. (1.3)
  double load_integral(double power) const;
  /// The load that, constant over the same path, gives the same life [N]; the path is not 0. Eq. (2.1)
  double equivalent_load(double exponent) const;
  double swing() const;       // from the least to the largest angle of a row [rad]
  double peak_rate() const;   // of a row, without sign [rad/s]
  double peak_power() const;  // largest |F| |rate| of a row [N*rad/s]

  /// With every second row only, and the last: how far its integrals are from those of all rows is a measure of their error. At least
  /// three rows.
  Duty thinned() const;
  std::size_t n_rows() const { return rows_.size(); }

 private:
  std::vector<DutyRow> rows_;
};

}  // namespace pintle
