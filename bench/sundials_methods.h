// The integrators of SUNDIALS on a mechanism, each on the equations as they stand, with joint forces read from the laws at
// the output times.
#pragma once

#include <string>
#include <vector>

#include "bench/force_samples.h"
#include "integrators/sundials_code.h"

namespace pintle::bench {

using Family = SundialsChoice::Family;
using LinearSolver = SundialsChoice::LinearSolver;

/// What a relative tolerance refers to.
enum class Weights {
  kPlain,  ///< rtol = atol = the tolerance, in SI units, for every component: what one gets without thinking
  kForce,  ///< positions to tolerance x force / stiffness, velocities to tolerance x force / impedance
};

struct PeerMethod {
  std::string name;
  SundialsChoice code;
  Weights weights = Weights::kPlain;
  bool stop_at_outputs = false;  // end steps at output times rather than interpolate
};

/// The problem that every method solves.
struct Problem {
  const System* system = nullptr;
  const State* start = nullptr;
  std::vector<double> outputs;
  double force = 1, stiffness = 1, impedance = 1;  // for Weights::kForce [N, N/m, N*s/m]
};

struct PeerRun {
  bool completed = false;
  double seconds = 0;
  long steps = 0, evaluations = 0;
  ForceSamples samples;
};

PeerRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance);

}  // namespace pintle::bench
