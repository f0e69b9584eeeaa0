// Monitors the run between output rows, so that a table that misses a peak or part of the work says so.
#pragma once

#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

template <class S>
class BasicMissedPeaks {
 public:
  explicit BasicMissedPeaks(const BasicSystem<S>& system);
  /// An output row; `power` [W] is all that motors and applied forces supply, `kinetic` [J] the energy.
  void add_row(const BasicState<S>& state, double power, double kinetic);
  /// The end of a step of h seconds.
  void add_step(const BasicState<S>& state, double h);
  /// Which joint's force is larger between rows by more than a hundredth, or how much of the work the rows miss; empty: neither.
  /// `output_step` [s] is that of the rows.
  std::string note(double output_step) const;

 private:
  struct Peak {
    double square = 0, t = 0, h = 0;  // [N^2], [s], [s]
  };
  std::string missed_peak(double output_step) const;
  std::string missed_work() const;

  const BasicSystem<S>& system_;
  std::vector<double> in_rows_;  // squares of the largest forces [N^2], per joint
  std::vector<Peak> at_steps_;
  double t_ = 0, power_ = 0, supplied_ = 0, supplied_before_ = 0;  // of the last row [s], [W], [J]; of the first [J]
  double work_ = 0, moved_ = 0, kinetic_ = 0;                      // by the rows' power, and by its size; the largest energy [J]
  bool any_row_ = false;
};
using MissedPeaks = BasicMissedPeaks<Planar>;

}  // namespace pintle
