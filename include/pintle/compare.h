// Runs side by side: one mechanism with compliant joints against ideal ones, or against relative coordinates, point by point; several
// variants of a mechanism joint by joint.
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
  kPhysical,   ///< beyond them: what the joints' compliance does
  kNotUnique,  ///< redundant ideal constraints leave the force undetermined
  kChaotic,    ///< a peak comes after the time up to which the force is promised
  kNoEstimate, ///< a run stopped before its second integration: its errors are not known
};

/// How far two runs are apart in one quantity, over all output times both have.
struct Difference {
  std::string name;                      ///< a joint, or a column
  std::string unit;
  double peak = 0;                       ///< of the magnitude, in the second run
  double largest = 0, rms = 0;           ///< of the difference; a joint force's is that of the vectors
  double largest_time = 0;               ///< [s]
  double relative = 0, relative_rms = 0; ///< over the peak, or over a ten-thousandth of the largest peak of the same unit [-]
  double error_estimate = 0;             ///< both runs' own, added; 0 for coordinates; not a number where a run has none
  int digits = 0;                        ///< significant figures in which both agree, 15 at most
  Cause cause = Cause::kNone;
};

/// The share of a joint in the elastic energy that all joints store at their peaks, a measure of who gives way [-].
struct Softness {
  std::string joint;
  double share = 0;
};

struct Comparison {
  Trajectory first, second;
  Equations against = Equations::kIdeal;
  double until = std::numeric_limits<double>::infinity();  ///< what comes later is not compared: the motion of one of them is chaotic [s]
  std::vector<Difference> forces, couples, coordinates;
  std::vector<Softness> softness;  ///< softest first; joints with a linear law
};

/// The significant figures that a relative difference leaves: 4 for 5e-5 and less, 3 for 5e-4 and less.
int agreeing_digits(double relative_difference);

/// Runs `model` with every joint a force law and again with the equations `against`. Throws AssemblyError.
Comparison compare(const Model& model, Equations against, const Observer& observer = {});

/// The differences of two runs that are there already.
Comparison compare(const Model& model, Trajectory first, Trajectory second, Equations against);

/// A run and what it is called.
struct NamedRun {
  std::string name;
  Trajectory run;
};

/// What a joint carries in one of several runs, and how far that is from the first of them.
struct VariantLoad {
  bool there = false;  ///< this run has the joint
  LoadSummary load;
  double peak_change = 0, mean_change = 0, rms_change = 0;  ///< over the first run's value [-]; not a number where that has none
  Cause cause = Cause::kNone;                               ///< of the peak's difference
};

struct VariantJoint {
  std::string joint;
  std::vector<VariantLoad> loads;  ///< one per run
};

struct Variants {
  std::vector<NamedRun> runs;
  std::vector<VariantJoint> joints;  ///< by name, in the order in which the runs have them
};

/// Peak, mean and RMS of every joint's force in each run beside those in the first.
Variants compare(std::vector<NamedRun> runs);

}  // namespace pintle
