// Equations of motion with all their forces, linearised at an instant: what small motions about it do.
#pragma once

#include <Eigen/Core>

#include "system/state.h"

namespace pintle {

/// As a fraction of the largest eigenvalue: smaller ones are not told from free motions, whose eigenvalue 0 is a double one, of which rounding makes the root of the machine precision:
/// up to 1.9e-8 in the collection (stick_slip). The slowest swing of a chain of 10 bars on pins of 1e11 N/m is at 3.8e-7.
inline constexpr double kResolvedEigenvalue = 1e-7;

/// Positions, velocities and states of laws: rows of the Jacobian.
int motion_unknowns(const System& system);
/// The Jacobian of (M^1/2 q, M^1/2 v / w, z), with w the fastest undamped frequency of a body alone, so that its rows and columns are of one size. Its eigenvalues are those
/// of the equations of motion [1/s]. Only for joints that are force laws.
Eigen::MatrixXd motion_jacobian(const System& system, const State& at);

}  // namespace pintle
