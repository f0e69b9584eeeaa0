// Wear of pins with clearance and of their bushes, by sectors around them. theory/bearing_life section 5.
#pragma once

#include <vector>

#include "pintle/trajectory.h"
#include "run/record/sampled_curve.h"
#include "system/state.h"

namespace pintle {

template <class S>
class BasicWearTally {
 public:
  static constexpr int kSectors = 72;  // of a bush, 5 degrees each: a polar diagram's resolution

  /// For the joints whose law reports `wear_power` and `contact_angle`.
  explicit BasicWearTally(const BasicSystem<S>& system);

  bool empty() const { return worn_.empty(); }
  /// Takes sample i of a step.
  void sample(int i, const BasicState<S>& state);
  /// The number of equal parts into which the step with the present samples on `grid` must be divided, so that pins and contacts turn by a small part of a sector
  /// in each, and a kink, as where slip reverses, is seen; 0: these samples are enough.
  int finer_parts(const CurveGrid& grid) const;
  /// Adds a step of h seconds from the curves through the samples of `grid`.
  void add_curve(const CurveGrid& grid, double h);
  /// Adds a step of h seconds by the trapezoidal rule between n + 1 equidistant samples.
  void add_trapezoids(int n, double h);
  std::vector<JointWear> result() const;

 private:
  struct Sample {
    double power = 0;                // [W]
    double on_bush = 0, on_pin = 0;  // angles of the contact [rad]
  };
  struct Worn {
    int joint;
    std::size_t power, angle;  // columns of its law
    JointWear wear;
    std::vector<Sample> samples;
  };

  // Work between a sample and the next one [J].
  static void add(Worn& worn, int after, double work);
  const std::vector<double>& observe(const Worn& worn, const BasicState<S>& state) const;

  const BasicSystem<S>& system_;
  std::vector<Worn> worn_;
  mutable std::vector<double> observed_;  // reused so that steps do not allocate
};
using WearTally = BasicWearTally<Planar>;

}  // namespace pintle
