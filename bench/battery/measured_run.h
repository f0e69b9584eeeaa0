// A random mechanism run at some tolerance and compared with its truth: what the run promised and whether it kept that.
#pragma once

#include <string>
#include <vector>

#include "bench/battery/random_mechanisms.h"
#include "bench/joint_errors.h"
#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle::bench {

/// A run at a tolerance so tight that its errors are negligible in the comparison.
struct TrueMotion {
  Model model;
  std::string refused;   // why the model could not be read or assembled
  Trajectory dense;      // with additional rows between those of the runs
  bool usable = false;   // it reached the end or a horizon
  double error = 0;      // its largest stated error [-]
  std::string jump;      // the joint whose force in the first row does not fit the following rows
  double jump_size = 0;  // relative to its peak [-]
};

struct BatteryLimits {
  double run = 20, truth = 60;  // processor time [s]
  double truth_tolerance = 1e-7;
};

TrueMotion true_motion(const RandomMechanism& mechanism, const BatteryLimits& limits);

struct MeasuredRun {
  enum class Ended { kFinished, kRefused, kThrew, kHung };
  std::string name, kind;
  double tolerance = 0;
  Ended ended = Ended::kFinished;
  Outcome outcome = Outcome::kCompleted;
  std::string message;
  std::uint64_t steps = 0, passes = 0;
  double seconds = 0;               // processor time
  bool judged = false;              // its truth is accurate enough
  JointError worst;                 // of the joints, the one with the largest error
  double doubt = 0;                 // error of the truth for that joint [-]
  double dishonesty = 1;            // factor by which stated over true error of that joint is outside 1/3 to 30 [-]
  int joints = 0, honest_joints = 0;
  bool over() const { return judged && worst.error - doubt > tolerance; }
  /// Its outcome claims that the forces are right, to the tolerance or up to a time, but they are not.
  bool broke_its_promise() const;
  bool states_too_little() const { return judged && dishonesty > 1 && worst.ratio() < 1; }
  bool states_too_much() const { return judged && dishonesty > 1 && worst.ratio() > 1; }
};

MeasuredRun measured_run(const RandomMechanism& mechanism, const TrueMotion& truth, double tolerance, const BatteryLimits& limits);

}  // namespace pintle::bench
