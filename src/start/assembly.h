// Computes an initial state: positions that close every loop, consistent velocities, joint preload.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "start/settle_joints.h"

namespace pintle {

struct Assembly : BasicSettledStart<Planar> {
  std::vector<std::string> not_unique;  // ideal equations: joints whose reactions they do not determine
  double largest_move = 0;              // of a centre of mass that was stated [m]
};

/// Positions and velocities only; the state has no forces yet. Completes `system`. Throws AssemblyError when a loop cannot close.
Assembly assemble_bodies(const Model& model, System& system);

/// Assembles `model`; completes `system` (made by build_system from it). Throws AssemblyError when a loop cannot close.
Assembly assemble(const Model& model, System& system);

}  // namespace pintle
