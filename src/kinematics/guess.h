// First guesses of positions and velocities from what the model states, along the joint graph.
#pragma once

#include <string>

#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Positions: stated ones; others by putting bodies onto their neighbours' joints, starting from the ground.
Vecs guess_positions(const Model& model, const System& system);

/// Velocities: stated ones, others zero.
Vecs stated_velocities(const Model& model);

/// Velocities: stated ones; a body of which nothing is stated moves with the one that it hangs on, as if their joint were locked, and where only the
/// spin is stated, the joint moves with that one.
Vecs guess_velocities(const Model& model, const System& system, const Vecs& q);

bool all_positions_stated(const Model& model);

/// Names of the joints along a closed loop that holds one of the joints named in `text`.
std::string loop_through(const System& system, const std::string& text);

}  // namespace pintle
