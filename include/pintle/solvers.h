// Work-precision study of the integration methods on one model: cost and accuracy of the joint forces of each method.
// theory/solvers section 5.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pintle/model.h"

namespace pintle {

/// The words of the methods that are compared on a model with these equations: kNewtonian, or equations with constraints. Empty for all others.
std::vector<std::string> solver_methods(Equations equations);

struct SolverStudyOptions {
  std::vector<std::string> methods;  ///< empty: all
  std::vector<double> tolerances{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  double time_limit = 10;         ///< of one integration [s]
  double truth_tolerance = 1e-9;  ///< of the reference run against which all are measured
};

enum class SolverEnd { kCompleted, kOutOfTime, kFailed, kInterrupted };

/// One integration. Errors are the largest over the output times; they are NaN if the run did not reach the end.
struct SolverRun {
  std::string method;
  double tolerance = 0;
  SolverEnd end = SolverEnd::kCompleted;
  std::string message;        ///< why it did not reach the end
  double t_end = 0;           ///< time reached [s]
  double steps = 0, rejected = 0, evaluations = 0, newton_iterations = 0, factorizations = 0;
  double seconds = 0;         ///< wall time, including recording at the output times; the least of five for short runs
  double force_error = 0;     ///< of a joint's force (or couple), over that joint's peak [-]
  std::string worst_joint;    ///< the joint with that error
  double position_error = 0;  ///< of a centre of mass [m]
  double angle_error = 0;     ///< of a body [rad]
  double vibration = 0;       ///< parasitic vibration: peak to peak, in the joint where it is largest relative to the joint's peak [N]
  double vibration_of_peak = 0;  ///< the same over that joint's peak [-]
  std::string vibrating_joint;
  double energy_drift = 0;    ///< of the energy account [J]
};

/// The order at which the force error of a method falls with its steps: error ~ steps^-order, by least squares over the
/// runs whose error is above that of the truth and below the coarsest.
struct SolverOrder {
  std::string method;
  int runs = 0;      ///< number of runs it was fitted to
  double order = 0;  ///< NaN: fewer than two runs, or all with about the same number of steps (stability limits them)
};

/// The run that is taken as the truth.
struct SolverTruth {
  std::string method;
  double tolerance = 0;       ///< asked for
  double error_estimate = 0;  ///< its own error estimate, the largest over the joints, relative to the joint's peak [-]
  bool complete = false;      ///< it reached the end
  std::string message;        ///< why it did not reach the end, or did not meet its tolerance
  double seconds = 0;
};

struct SolverStudy {
  double duration = 0, output_step = 0;  ///< [s]
  double window = 0;                     ///< length of the running mean against which vibration is measured [s]
  double slowest_vibration = 0;          ///< of a joint on its own spring [rad/s]; 0: none
  SolverTruth truth;
  std::vector<SolverRun> runs;           ///< by method, then tolerance
  std::vector<SolverOrder> orders;
  std::vector<std::string> notes;        ///< which methods are left out, and why
  bool interrupted = false;
};

/// Called between steps; return false to stop.
using KeepGoing = std::function<bool()>;

/// Runs every method at every tolerance from the same start. On a model with constraints the truth is the run with multipliers,
/// and the methods are ways to satisfy the constraints. Throws AssemblyError, and std::invalid_argument for a word that is not a
/// method, a tolerance that is not positive, or relative coordinates.
SolverStudy compare_solvers(const Model& model, const SolverStudyOptions& options, const KeepGoing& keep_going = {});

}  // namespace pintle
