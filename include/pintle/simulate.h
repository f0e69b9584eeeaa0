// Runs a model: from a model to a trajectory.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// Passed to the observer from time to time. `pass` counts the integrations of one run: the pilot (1) and the reported
/// one; it is 0 while a large mechanism is assembled.
struct Progress {
  double t = 0;         ///< model time reached [s]
  double duration = 0;  ///< [s]
  int pass = 1;
  double wall_seconds = 0;
};

/// Called about ten times a second at most; return false to stop (the results so far are kept).
using Observer = std::function<bool(const Progress&)>;

/// The mechanism cannot be assembled: which loop does not close, and by how much.
class AssemblyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs `model` according to its `simulate` settings. Throws AssemblyError; and std::invalid_argument where a model made in a program has names that do not
/// exist, keys that a law does not have, or numbers out of range. A numerical failure or an interruption is reported in the trajectory's outcome,
/// along with everything computed until then. Models share nothing: several threads may each run their own.
Trajectory simulate(const Model& model, const Observer& observer = {});

}  // namespace pintle
