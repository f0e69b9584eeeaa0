// Which joints turn so much into heat that one would look at it.
#pragma once

#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// In their order; none where the run loses next to nothing of the energy that moves.
std::vector<const LoadSummary*> joints_with_heat(const Trajectory& run);

/// What they and the dampers turn into heat. A joint whose stick spring is loaded when it comes to rest has less of it than none until it slips again; then the sum of all by their size, if that is more [J].
double heat_of_all(const Trajectory& run);

/// Whether anything moves by more than the rounding of the energy that is stored: what a ratio to the kinetic energy needs.
bool is_moving(const EnergyAccount& energy);

}  // namespace pintle
