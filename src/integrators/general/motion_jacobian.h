// Equations of motion with all their forces, linearised at an instant: what small motions about it do.
#pragma once

#include <Eigen/Core>

#include "system/state.h"

namespace pintle {

/// Positions, velocities and states of laws: rows of the Jacobian.
int motion_unknowns(const System& system);
/// The Jacobian of (M^1/2 q, M^1/2 v / w, z), with w the fastest undamped frequency of a body alone, so that its rows and columns are of one size. Its eigenvalues are those
/// of the equations of motion [1/s]. Only for joints that are force laws.
Eigen::MatrixXd motion_jacobian(const System& system, const State& at);

}  // namespace pintle
