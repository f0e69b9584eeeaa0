// The integrators of SUNDIALS on a mechanism, each applied to the unmodified equations, with joint forces computed from the laws at
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

/// What a tolerance refers to.
enum class Weights {
  kPlain,  ///< rtol = atol = the tolerance, in SI units, for every component: the naive choice
  kForce,  ///< positions to tolerance x force / stiffness, velocities to tolerance x force / impedance
};

struct PeerMethod {
  std::string name;
  SundialsChoice code;
  Weights weights = Weights::kPlain;
  bool stop_at_outputs = false;  // end steps at output times instead of interpolating
};

/// A method with the tolerances worth trying.
using PeerLadder = std::pair<PeerMethod, std::vector<double>>;
/// The best few, or every promising method.
std::vector<PeerLadder> peer_ladders(bool all);
/// An explicit method of order 8, for references.
PeerMethod explicit_witness();

/// Tolerances from 10^from to 10^to, in decreasing order.
std::vector<double> decades(int from, int to, int per_decade = 1);

MethodRun run_sundials(const PeerMethod& method, const Problem& problem, double tolerance);

}  // namespace pintle::bench
