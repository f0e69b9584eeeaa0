// Computes an initial state: positions that close every loop, consistent velocities, joint preload.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "start/settle_joints.h"
#include "system/system.h"

namespace pintle {

/// An assembled mechanism: its complete system and the state that it starts from.
struct Assembly : BasicSettledStart<Planar> {
  System system;
  std::vector<std::string> not_unique;  // ideal equations: joints whose reactions are not determined
  double largest_move = 0;              // largest displacement of a stated centre of mass [m]
};

/// Assembles `model`. Throws AssemblyError when a loop cannot close.
Assembly assemble(const Model& model);

/// Positions and velocities only; the state has no forces yet. `like`: a system that the model's may be a variant of. Throws
/// AssemblyError when a loop cannot close.
Assembly assemble_bodies(const Model& model, const System* like = nullptr);

/// Positions and velocities, without joint forces, of a system that build_system has made from `model`.
Assembly assemble_unloaded(const Model& model, System system);

/// As `assemble`, for such a system.
Assembly assemble_system(const Model& model, System system);

}  // namespace pintle
