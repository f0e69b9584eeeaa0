// Simbody on a mechanism. Ideal joints: a tree of mobilizers, with loops closed by constraints. Compliant joints: free bodies in the
// plane with a bushing at every joint. M. A. Sherman et al., Procedia IUTAM 2 (2011) 241-261. Only in builds that found Simbody.
#pragma once

#include <string>

#include "bench/problem.h"

namespace pintle::bench {

struct SimbodyMethod {
  enum class Joints { kTree, kBushings };
  enum class Integrator { kRungeKuttaMerson, kBdf };

  std::string name;
  Joints joints = Joints::kTree;
  Integrator integrator = Integrator::kRungeKuttaMerson;
};

/// Joint forces are the reactions of Simbody's mobilizers and constraints, or those of the laws at its positions.
MethodRun run_simbody(const SimbodyMethod& method, const Problem& problem, double accuracy);

std::string simbody_version();

}  // namespace pintle::bench
