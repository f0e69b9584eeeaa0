// Joints with play at the start: in the middle of their play, where assembly puts them, or seated against the side that their load presses them to.
#pragma once

#include <string>
#include <vector>

#include "start/assembly.h"

namespace pintle {

/// Whether assembly leaves the joint free in the middle of its play between two sides: a pin in its bush, a slide in its guideway, teeth between teeth. A
/// rope or a floor has only one side.
bool has_play(const JointData& joint);

/// The joints that have play.
std::vector<int> joints_in_play(const System& system);

/// Names separated by commas; "" if there are none.
std::string names_of_joints(const System& system, const std::vector<int>& joints);

/// Names of the joints in play, separated by commas; "" if there are none.
std::string names_of_joints_in_play(const System& system);
/// Only those that give no force where the state has them.
std::string names_of_joints_in_play(const System& system, const State& state);

/// Applies `seat_joints` to an assembled mechanism and adds a note.
void note_seated(Assembly& assembly);

/// Moves the bodies so that every joint of joints_in_play touches on the side to which the motion of the mechanism without play presses it, at the depth
/// at which its law gives that force. `state`: q and v of the assembled mechanism. Joints that carry nothing stay in the middle; their names are returned.
/// theory/assembly section 8.
std::string seat_joints(const System& system, State& state);

}  // namespace pintle
