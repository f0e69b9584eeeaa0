// Notes on what assembly has changed in stated positions and velocities, where a user would not expect it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Bodies that ended up far from where the file states them: their positions or markers are not as intended, or a unit is missing. `guess` has the stated
/// positions.
void note_moved_bodies(const Model& model, const Vecs& guess, const Vecs& q, std::vector<std::string>& notes);

inline constexpr std::array kCoordinates{"x", "y", "angle"};

/// Lists the coordinates in `hold` that have moved by more than `turn` [rad] or `way` [m], with old and new values; "" if none has.
std::string held_that_moved(const Model& model, const Vecs& from, const Vecs& to, double turn, double way);

/// Stated velocities that joints or motors have replaced by those in v.
void note_changed_velocities(const Model& model, const System& system, const Vecs& v, std::vector<std::string>& notes);

/// Teeth that do not reach each other and pulleys that overlap, which would carry their load all the same.
void note_discs_apart(const System& system, const Vecs& q, std::vector<std::string>& notes);

/// Bodies that nothing holds, moves or touches.
void note_unconnected_bodies(const System& system, std::vector<std::string>& notes);

/// Law lengths above the mechanism's size [m], and angles of many turns, as from values in mm or degrees without their unit.
void note_missing_units(const Model& model, double size, std::vector<std::string>& notes);

}  // namespace pintle
