// Comparison of runs: one mechanism with compliant joints against ideal ones, or against relative coordinates, point by point;
// several variants of a mechanism joint by joint.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "pintle/simulate.h"

namespace pintle {

/// Why two runs differ in a quantity.
enum class Cause {
  kNone,       ///< a coordinate: there is no error estimate to judge by
  kNumerical,  ///< within the runs' own error estimates
  kPhysical,   ///< beyond them: the effect of the joints' compliance
  kNotUnique,  ///< redundant ideal constraints leave the force undetermined
  kChaotic,    ///< a peak occurs after the time up to which the force is promised
  kNoEstimate, ///< a run stopped before its second integration, so its errors are not known
};

/// How far apart two runs are in one quantity, over all output times they share.
struct Difference {
  std::string name;                      ///< a joint, or a column
  std::string unit;
  double peak = 0;                       ///< of the magnitude, in the second run
  double largest = 0, rms = 0;           ///< of the difference; for joint forces, of the difference of the vectors
  double largest_time = 0;               ///< [s]
  double relative = 0, relative_rms = 0; ///< over the peak, or over a ten-thousandth of the largest peak of the same unit [-]
  double error_estimate = 0;             ///< the sum of both runs' own estimates; 0 for coordinates; NaN where a run has none
  int digits = 0;                        ///< significant figures to which they agree, 15 at most
  Cause cause = Cause::kNone;
};

/// The share of a joint in the elastic energy that all joints store at their peaks: a measure of which joint deflects most [-].
struct Softness {
  std::string joint;
  double share = 0;
};

struct Comparison {
  Trajectory first, second;
  Equations against = Equations::kIdeal;
  double until = std::numeric_limits<double>::infinity();  ///< end of the comparison: after it the motion of one of them is chaotic [s]
  std::vector<Difference> forces, couples, coordinates;
  std::vector<Softness> softness;  ///< softest first; joints with a linear law
};

/// The significant figures that a relative difference leaves: 4 for 5e-5 and less, 3 for 5e-4 and less.
int agreeing_digits(double relative_difference);

/// Runs `model` with every joint a force law and again with the equations `against`. Throws AssemblyError.
Comparison compare(const Model& model, Equations against, const Observer& observer = {});

/// The differences between two existing runs.
Comparison compare(const Model& model, Trajectory first, Trajectory second, Equations against);

/// A run and its name.
struct NamedRun {
  std::string name;
  Trajectory run;
};

/// The load on a joint in one of several runs, and its change from the first run.
struct VariantLoad {
  bool there = false;  ///< this run has the joint
  LoadSummary load;
  double peak_change = 0, mean_change = 0, rms_change = 0;  ///< over the first run's value [-]; NaN where the first run has none
  Cause cause = Cause::kNone;                               ///< of the peak's difference
};

struct VariantJoint {
  std::string joint;
  std::vector<VariantLoad> loads;  ///< one per run
};

struct Variants {
  std::vector<NamedRun> runs;
  std::vector<VariantJoint> joints;  ///< by name, in the order in which they appear in the runs
};

/// Peak, mean and RMS of every joint's force in each run, compared with those in the first.
Variants compare(std::vector<NamedRun> runs);

}  // namespace pintle
