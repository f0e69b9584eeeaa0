// How far the joint forces and positions of one trajectory are from those of another at the same output times.
// theory/solvers section 5.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

class JointErrors {
 public:
  /// Every trajectory that is measured must have the columns of `truth`.
  explicit JointErrors(const Trajectory& truth, double radius);

  struct Worst {
    double relative = 0, absolute = 0;  // [-], [N]
    std::string joint;
  };
  /// Largest error of any joint's force or couple, over its peak.
  Worst force_error(const Trajectory& run) const;
  /// Largest parasitic vibration of any joint's force, over its peak; `half_window` rows each side make the mean.
  Worst vibration(const Trajectory& run, std::size_t half_window) const;
  /// Largest error of a centre of mass [m] and of an angle [rad].
  std::array<double, 2> position_errors(const Trajectory& run) const;

 private:
  struct Joint {
    std::string name;
    int fx = -1, fy = -1, couple = -1;        // columns
    double peak = 0, peak_couple = 0;         // what errors are measured by
  };
  double vibration_of(const Trajectory& run, int column, std::size_t half_window) const;

  const Trajectory& truth_;
  std::vector<Joint> joints_;
  std::vector<int> positions_, angles_;
};

/// Peak to peak of the last half of d, its running mean (2 w + 1 rows, fewer at the end) taken off.
double peak_to_peak_of_fast_part(const std::vector<double>& d, std::size_t w);

}  // namespace pintle
