// Which joints generate enough heat to be worth listing.
#pragma once

#include <vector>

#include "pintle/trajectory.h"

namespace pintle {

/// In their order; none if the run loses a negligible part of its energy in motion.
std::vector<const LoadSummary*> joints_with_heat(const Trajectory& run);

/// The heat from joints and dampers [J]. A joint that comes to rest with its stick spring loaded has negative heat until it slips again; then the sum of all magnitudes applies, if it is larger.
double heat_of_all(const Trajectory& run);

/// Whether the motion exceeds the roundoff of the stored energy, as a ratio to the kinetic energy requires.
bool is_moving(const EnergyAccount& energy);

}  // namespace pintle
