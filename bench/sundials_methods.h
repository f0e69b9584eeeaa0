// The integrators of SUNDIALS on a mechanism, each on the equations as they stand, with joint forces read from the laws at
// the output times.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/problem.h"
#include "integrators/general/sundials_code.h"

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

/// A method with the tolerances that are worth trying.
using PeerLadder = std::pair<PeerMethod, std::vector<double>>;
/// The best few, or everything that has a chance.
std::vector<PeerLadder> peer_ladders(bool all);
/// An explicit method of order 8, for references.
PeerMethod explicit_witness();

/// Tolerances 10^from to 10^to, falling.
std::vector<double> decades(int from, int to, int per_decade = 1);

MethodRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance);

}  // namespace pintle::bench
