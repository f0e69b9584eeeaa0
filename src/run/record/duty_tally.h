// How far pins turn in their bushes, and under which load: integrals over the path of each, from curves inside every step. theory/bearing_life section 1.
#pragma once

#include <limits>
#include <vector>

#include "pintle/trajectory.h"
#include "run/record/sampled_curve.h"
#include "system/state.h"

namespace pintle {

/// Sums over the steps so far. Eq. (1.1) to (1.3)
struct DutySums {
  double path = 0;                                              // [rad]
  double load = 0, load_3 = 0, load_10_3 = 0;                   // of |F|^p over the path, p = 1, 3, 10/3 [N^p*rad]
  double least = std::numeric_limits<double>::infinity(), most = -least;  // angle [rad]
  double peak_rate = 0, peak_power = 0;                         // of |rate|, of |F| |rate| [rad/s], [N*rad/s]
};

/// Samples of a pin's angle in its bush and of its rate, at the samples of a grid.
struct TurnSamples {
  CurveGrid::Weights angle{}, rate{};  // [rad], [rad/s]
};

/// Samples of a force: component c of sample i at `first[i * stride + c]`, c < n.
struct ForceSamplesOfStep {
  const double* first;
  int stride, n;
};

/// Adds a step of h seconds, with the squares of the force at the points of the grid.
void add_duty(const CurveGrid& grid, const ForceSamplesOfStep& force, const CurveGrid::AtPoints& squares, const TurnSamples& turn, double h, DutySums& sums);

template <class S>
class BasicDutyTally {
 public:
  /// For pins: joints that turn freely and carry a force.
  explicit BasicDutyTally(const BasicSystem<S>& system);

  /// Takes sample i of a step.
  void sample(int i, const BasicState<S>& state);
  /// Adds a step of h seconds for a joint, if it is a pin, from the curves through the samples of `grid`, with the squares of its force at the points.
  void add_curve(int joint, const CurveGrid& grid, const ForceSamplesOfStep& force, const CurveGrid::AtPoints& squares, double h);
  std::vector<PinDuty> result() const;

 private:
  struct Pin {
    int joint;
    DutySums sums;
    TurnSamples samples;
  };

  const BasicSystem<S>& system_;
  std::vector<Pin> pins_;
  std::vector<int> pin_of_;  // per joint; -1: none
};

}  // namespace pintle
