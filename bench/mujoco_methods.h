// MuJoCo on a mechanism: a tree of hinges and slides, with loops closed by "connect" constraints, which are inherently soft.
// E. Todorov et al., IROS 2012. Only in builds that found MuJoCo.
#pragma once

#include <string>

#include "bench/problem.h"

namespace pintle::bench {

struct MujocoMethod {
  std::string name;
  std::string integrator = "implicit";  // Euler, RK4, implicit
  double softness = 2;                  // time constant of the constraints, in steps
};

/// Fixed steps of about `step` that end at the output times. Positions only: MuJoCo's constraint forces are not those of ideal joints.
MethodRun run_mujoco(const MujocoMethod& method, const Problem& problem, double step);

std::string mujoco_version();

}  // namespace pintle::bench
