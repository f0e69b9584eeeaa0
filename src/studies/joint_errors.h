// Differences of the joint forces and positions of one trajectory from those of another at the same output times.
// theory/solvers section 5.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

class JointErrors {
 public:
  /// Every trajectory compared must have the columns of `truth`.
  explicit JointErrors(const Trajectory& truth, double radius);

  struct Worst {
    double relative = 0, absolute = 0;  // [-], [N]
    std::string joint;
  };
  /// Largest error of any joint's force or couple, relative to its peak.
  Worst force_error(const Trajectory& run) const;
  /// Largest parasitic vibration of any joint's force, relative to its peak; the mean is over `half_window` rows
  /// on each side.
  Worst vibration(const Trajectory& run, std::size_t half_window) const;
  /// Largest error of a centre of mass [m] and of an angle [rad].
  std::array<double, 2> position_errors(const Trajectory& run) const;

 private:
  struct Joint {
    std::string name;
    int fx = -1, fy = -1, couple = -1;        // columns
    double peak = 0, peak_couple = 0;         // that errors are relative to
  };
  double vibration_of(const Trajectory& run, int column, std::size_t half_window) const;

  const Trajectory& truth_;
  std::vector<Joint> joints_;
  std::vector<int> positions_, angles_;
};

/// Peak-to-peak value of the last half of d, less its running mean (2 w + 1 rows, fewer at the end).
double peak_to_peak_of_fast_part(const std::vector<double>& d, std::size_t w);

}  // namespace pintle
