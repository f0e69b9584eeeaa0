// Checks every formula that a run of this model uses against finite differences and the energy balance.
#pragma once

#include "check/check_links.h"
#include "pintle/check.h"

namespace pintle {

constexpr double kSlopeTolerance = 1e-6;     // for fourth-order differences
constexpr double kIdentityTolerance = 1e-9;  // for quantities that should vanish apart from roundoff

/// Jacobians, rates and second derivatives of joint displacements; tangents of laws, loads and expressions; the whole
/// mechanism.
CheckBattery jacobian_battery(const System& system, const State& assembled, const std::vector<CheckState>& states,
                              double duration);

/// Opposite forces, potentials, losses, rigid motion, and the power balance.
CheckBattery energy_battery(const System& system, const State& assembled, const std::vector<CheckState>& states);

// The parts of the batteries, one file each.
void check_displacement_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery);
void check_law_slopes(const System& system, const State& assembled, const std::vector<CheckState>& states,
                      CheckBattery& battery);
void check_load_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery);
void check_expressions(const System& system, const std::vector<CheckState>& states, double duration,
                       CheckBattery& battery);
void check_whole_slopes(const System& system, const std::vector<CheckState>& states, CheckBattery& battery);
void check_link_forces(const System& system, const std::vector<CheckState>& states, CheckBattery& battery);
void check_law_energy(const System& system, const State& assembled, const std::vector<CheckState>& states,
                      CheckBattery& battery);
void check_power_account(const System& system, const std::vector<CheckState>& states, CheckBattery& battery);

}  // namespace pintle
