// Joints with play at the start: in the middle of it, where assembly puts them, or seated against the side that their load presses them to.
#pragma once

#include <string>
#include <vector>

#include "start/assembly.h"

namespace pintle {

/// Whether assembly leaves the joint free in the middle of a play with two sides: a pin in its bush, a slide in its way, teeth between teeth. A rope or a
/// floor has one side.
bool has_play(const JointData& joint);

/// Those that have.
std::vector<int> joints_in_play(const System& system);

/// With commas between; "" of none.
std::string names_of_joints(const System& system, const std::vector<int>& joints);

/// Their names, with commas between; "" where there are none.
std::string names_of_joints_in_play(const System& system);
/// Of these the ones that do not answer where the state has them.
std::string names_of_joints_in_play(const System& system, const State& state);

/// `seat_joints` of what has been assembled, with a note.
void note_seated(Assembly& assembly);

/// Moves the bodies so that every joint of joints_in_play touches where the motion of the mechanism without play presses it, as deep as its law gives that
/// force. `state`: q and v of the assembled mechanism. Joints that carry nothing stay in the middle; their names are returned. theory/assembly section 8.
std::string seat_joints(const System& system, State& state);

}  // namespace pintle
