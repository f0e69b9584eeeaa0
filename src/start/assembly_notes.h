// What assembly has made of stated positions and velocities, where a user would not expect it.
#pragma once

#include <string>
#include <vector>

#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Bodies that came to lie far from where the file states them: these were meant otherwise, or their markers, or a unit is missing. `guess` has the stated
/// positions.
void note_moved_bodies(const Model& model, const Vecs& guess, const Vecs& q, std::vector<std::string>& notes);

/// Velocities that joints or motors have replaced; `stated` has those of the file.
void note_changed_velocities(const Model& model, const Vecs& stated, const Vecs& v, std::vector<std::string>& notes);

/// Teeth that are away from each other, and pulleys that overlap, would still carry their load.
void note_discs_apart(const System& system, const Vecs& q, std::vector<std::string>& notes);

}  // namespace pintle
