#include "results/heat.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

constexpr double kNoHeat = 1e-6;      // of the energy that moves
constexpr double kLittleHeat = 1e-3;  // of all that is lost

}  // namespace

std::vector<const LoadSummary*> joints_with_heat(const Trajectory& run) {
  std::vector<const LoadSummary*> out;
  const EnergyAccount& energy = run.energy;
  if (!(energy.dissipated > kNoHeat * std::max(energy.kinetic_peak, std::abs(energy.supplied)))) return out;
  for (const LoadSummary& joint : run.joints)
    if (joint.heat > kLittleHeat * energy.dissipated) out.push_back(&joint);
  return out;
}

}  // namespace pintle
