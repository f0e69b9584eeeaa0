// The true error of a run's joint forces, from a much tighter run, together with the error that the run states.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle::bench {

struct JointError {
  std::string joint;
  double error = 0;     // largest at the output times up to its horizon, relative to the joint's peak force or couple [-]
  double of_force = 0;  // of the force alone [-]
  bool couple = false;  // whether the couple has the larger error
  double estimate = 0;  // as stated by the run [-]
  double ratio() const { return estimate / error; }
};

/// One entry per joint. A joint with less than the fraction `negligible` of the largest force of the mechanism is
/// measured by that fraction; couples likewise, by the largest couple or force times radius of gyration, theory/time
/// (6.1). Empty if the two runs do not have the same rows.
std::vector<JointError> joint_errors(const Model& model, const Trajectory& run, const Trajectory& reference,
                                     double negligible);

/// The entry with the largest error.
const JointError& worst_of(const std::vector<JointError>& joints);

}  // namespace pintle::bench
