// Surfaces that touch at the start, as a wheel that is put onto its road: they press on each other from the first instant.
#pragma once

#include <vector>

#include "start/assembly.h"

namespace pintle {

/// Moves the bodies so that one-sided contacts that touch without moving towards each other are as deep as carries what the motion needs of them. Contacts that would
/// have to pull stay where they are, and are returned; so does `state` where no forces are found. `state`: q and v of the assembled
/// mechanism. theory/assembly section 3.
std::vector<int> press_touching_surfaces(const System& system, State& state);

/// The same of what has been assembled, with a note.
void press_touching_surfaces(Assembly& assembly);

}  // namespace pintle
