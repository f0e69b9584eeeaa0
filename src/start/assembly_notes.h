// What assembly has made of stated positions and velocities, where a user would not expect it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dynamics/inverse_dynamics.h"
#include "pintle/model.h"
#include "system/system.h"

namespace pintle {

/// Bodies that came to lie far from where the file states them: these were meant otherwise, or their markers, or a unit is missing. `guess` has the stated
/// positions.
void note_moved_bodies(const Model& model, const Vecs& guess, const Vecs& q, std::vector<std::string>& notes);

inline constexpr std::array kCoordinates{"x", "y", "angle"};

/// Which coordinates in `hold` have gone from where they were by more than `turn` [rad] or `way` [m], from where to where; "" if none has.
std::string held_that_moved(const Model& model, const Vecs& from, const Vecs& to, double turn, double way);

/// Stated velocities that joints or motors have replaced by those of v.
void note_changed_velocities(const Model& model, const System& system, const Vecs& v, std::vector<std::string>& notes);

/// Teeth that are away from each other, and pulleys that overlap, would still carry their load.
void note_discs_apart(const System& system, const Vecs& q, std::vector<std::string>& notes);

/// Bodies that nothing holds, moves or touches.
void note_unconnected_bodies(const System& system, std::vector<std::string>& notes);

/// Lengths of laws above the mechanism's size [m], and angles of many turns, as values in mm or degrees are whose unit was left out.
void note_missing_units(const Model& model, double size, std::vector<std::string>& notes);

}  // namespace pintle
