// Surfaces that touch at the start, such as a wheel placed on its road: they press on each other from the first instant.
#pragma once

#include <vector>

#include "start/assembly.h"

namespace pintle {

/// Moves the bodies so that one-sided contacts that touch without approaching each other have the depth at which they carry the forces that the motion needs.
/// Contacts that would have to pull stay where they are and are returned. `state` stays as it is if no forces are found. `state`: q and v of the assembled mechanism.
/// theory/assembly section 3.
std::vector<int> press_touching_surfaces(const System& system, State& state);

/// The same for an assembled mechanism, with a note.
void press_touching_surfaces(Assembly& assembly);

}  // namespace pintle
