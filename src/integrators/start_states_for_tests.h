// Start states for integrators, made without the rooms to the right: plain ones, and ones whose joints carry the
// reactions of ideal joints, found by dense elimination.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "integrators/absolute/stage_solver.h"
#include "system/sample_systems_for_tests.h"
#include "system/state.h"

namespace pintle::sample {

/// The state as the model states it, with no joint preload but that of its positions.
State plain_start(const Model& model, const System& system);

/// Mass, Jacobian and convective term as dense matrices, for the gap's stiff components only (those with stiffness).
struct DenseEquations {
  Eigen::VectorXd mass, Q, bias;
  Eigen::MatrixXd G;
  std::vector<std::pair<int, int>> rows;  // joint, component

  DenseEquations(const System& system, double t, const Vecs& q, const Vecs& v);
  /// Reactions of ideal joints: G M^-1 (Q + G' f) + bias = 0.
  Eigen::VectorXd reactions() const;
};

/// Linear joints only: the gaps carry the reactions of ideal joints, the positions are moved onto these gaps.
State loaded_start(const Model& model, const System& system);

/// A body of 2 kg on a spring of 50 N/m along x, driven by 3 cos(7 t) N; at rest at x = 1.5 m, free length 1 m.
Model oscillator();
/// Its position and speed at time t.
std::array<double, 2> oscillator_at(double t);

/// A state on the joints' slow motion: the loaded start, followed for t seconds with a tight tolerance.
State settled_start(const Model& model, const System& system, double t);

/// n equal steps without error control.
State follow(const System& system, const State& from, double duration, int n, int stages = 3);

StageTails room_for_tails(const System& system);

double largest_difference(const Vecs& a, const Vecs& b);

/// The smallest slope of log(error) over log(step) between neighbours, for the errors of steps halved each time.
double measured_order(const std::vector<double>& errors);

}  // namespace pintle::sample
