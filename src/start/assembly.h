// Computes an initial state: positions that close every loop, consistent velocities, joint preload.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "start/settle_joints.h"
#include "system/system.h"

namespace pintle {

/// A mechanism that has been put together: its system, complete, and the state that it starts from.
struct Assembly : BasicSettledStart<Planar> {
  System system;
  std::vector<std::string> not_unique;  // ideal equations: joints whose reactions they do not determine
  double largest_move = 0;              // of a centre of mass that was stated [m]
};

/// Assembles `model`. Throws AssemblyError when a loop cannot close.
Assembly assemble(const Model& model);

/// Positions and velocities only; the state has no forces yet. `like`: a system of which the model's may be a variant. Throws
/// AssemblyError when a loop cannot close.
Assembly assemble_bodies(const Model& model, const System* like = nullptr);

/// Of a system that build_system has made from `model`: its positions and velocities, without forces in the joints.
Assembly assemble_unloaded(const Model& model, System system);

/// As `assemble`, of such a system.
Assembly assemble_system(const Model& model, System system);

}  // namespace pintle
