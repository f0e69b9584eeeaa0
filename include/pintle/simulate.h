// From a model to a trajectory.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "pintle/model.h"
#include "pintle/trajectory.h"

namespace pintle {

/// Passed to the observer now and then. `pass` counts the integrations of one run: the pilot (1) and the reported one;
/// 0 while a large mechanism is assembled.
struct Progress {
  double t = 0;         ///< model time reached [s]
  double duration = 0;  ///< [s]
  int pass = 1;
  double wall_seconds = 0;
};

/// Called about ten times a second at most; return false to stop (results so far are kept).
using Observer = std::function<bool(const Progress&)>;

/// The mechanism cannot be assembled: which loop, by how much.
class AssemblyError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs `model` as its `simulate` settings say. Throws AssemblyError; a numerical failure or an interruption is a value
/// in the trajectory's outcome, with everything computed until then.
Trajectory simulate(const Model& model, const Observer& observer = {});

}  // namespace pintle
