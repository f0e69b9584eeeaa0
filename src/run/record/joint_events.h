// The events in joints, for the results: touches, slips, and what each has cost.
#pragma once

#include <vector>

#include "integrators/law_crossings.h"
#include "pintle/trajectory.h"
#include "system/system.h"

namespace pintle {

/// The crossings joint by joint. With `heat`, what each joint had turned into heat by each crossing [J], every event includes what its joint has lost since its
/// previous one. Where surfaces stick, the energy stored by friction passes to their spring; it is lost again when they slip.
template <class S>
std::vector<JointEvents> events_of_joints(const BasicSystem<S>& system, const std::vector<LawCrossing>& crossings, const std::vector<double>& heat);

}  // namespace pintle
