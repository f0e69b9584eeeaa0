// Computes an initial state: positions that close every loop, consistent velocities, joint preload.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "system/state.h"

namespace pintle {

struct Assembly {
  State state;                     // t = 0
  std::vector<std::string> notes;  // what was assumed
  std::vector<std::string> not_unique;  // ideal equations: joints whose reactions they do not determine
  double span = 0;                 // over which the joints are smooth, where it was looked for [s]
  double settled_over = 0;         // the joints' slow motion was found over this time [s]; 0: it was not, or not looked for
  double largest_move = 0;         // of a centre of mass that was stated [m]
};

/// Positions and velocities only; the state has no forces yet. Settles `system`. Throws AssemblyError when a loop cannot close.
Assembly assemble_bodies(const Model& model, System& system);

/// Assembles `model`; settles `system` (made by build_system from it). Throws AssemblyError when a loop cannot close.
Assembly assemble(const Model& model, System& system);

}  // namespace pintle
