// First guesses of positions and velocities from the stated values, along the joint graph.
#pragma once

#include <string>

#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Positions: stated ones; others by attaching bodies to their neighbours' joints, starting from the ground.
Vecs guess_positions(const Model& model, const System& system);

/// Velocities: stated ones, others zero.
Vecs stated_velocities(const Model& model);

/// Velocities: stated ones. A body without stated velocities moves with the body that it is attached to, as if their joint were locked. If only its
/// spin is stated, its joint point moves with that body.
Vecs guess_velocities(const Model& model, const System& system, const Vecs& q);

bool all_positions_stated(const Model& model);

/// Names of the joints along a closed loop that contains one of the joints named in `text`.
std::string loop_through(const System& system, const std::string& text);

}  // namespace pintle
