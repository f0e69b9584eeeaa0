#include "results/heat.h"

#include <algorithm>
#include <cmath>

namespace pintle {
namespace {

constexpr double kNoHeat = 1e-6;      // fraction of the energy in motion
constexpr double kRounding = 1e-12;   // fraction of the stored energy: below this there is no motion
constexpr double kRoundedHeat = 1e-10;  // fraction of the stored energy: below this it is roundoff in the energy account
constexpr double kLittleHeat = 1e-3;  // fraction of all losses

double stored(const EnergyAccount& energy) { return std::max(std::abs(energy.potential_start), std::abs(energy.potential_end)); }

}  // namespace

bool is_moving(const EnergyAccount& energy) { return energy.kinetic_peak > kRounding * stored(energy); }

double heat_of_all(const Trajectory& run) {
  double sum = 0;
  for (const LoadSummary& joint : run.joints) sum += std::abs(joint.heat);
  return std::max(run.energy.dissipated, sum);
}

std::vector<const LoadSummary*> joints_with_heat(const Trajectory& run) {
  std::vector<const LoadSummary*> out;
  const EnergyAccount& energy = run.energy;
  const double all = heat_of_all(run);
  if (!(all > std::max(kNoHeat * std::max(energy.kinetic_peak, std::abs(energy.supplied)), kRoundedHeat * stored(energy)))) return out;
  for (const LoadSummary& joint : run.joints)
    if (std::abs(joint.heat) > kLittleHeat * all) out.push_back(&joint);
  return out;
}

}  // namespace pintle
