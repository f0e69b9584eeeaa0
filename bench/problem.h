// The problem that every method solves, and the result of one run of a method.
#pragma once

#include <limits>
#include <vector>

#include "bench/samples.h"

namespace pintle::bench {

struct Problem {
  const System* system = nullptr;
  const State* start = nullptr;
  std::vector<double> outputs;                     // times [s]
  double force = 1, stiffness = 1, impedance = 1;  // for Weights::kForce [N, N/m, N*s/m]
  FollowedPoint point{};
  double cap = std::numeric_limits<double>::infinity();  // a run that takes longer is abandoned [s]
};

struct MethodRun {
  bool completed = false;
  double seconds = 0;
  double steps = 0, evaluations = 0;
  Samples samples;
};

}  // namespace pintle::bench
