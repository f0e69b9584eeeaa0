// One coordinate of unit mass in one step of 1 s, with everything that a step does: collocation, carried gaps, and the projection onto
// them with the bodies held or free. The model of theory/time section 4.1, for its figure and its test.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "integrators/radau/radau_table.h"
#include "integrators/radau/step_error.h"

namespace pintle::linear_step {

/// The change of a gap per unit of the coordinate, in the stages and at the end of the step, and the gap's stiffness [1/s^2].
struct Gap {
  double stages = 1, end = 1, stiffness = 0;
};

/// The magnitude of the step's largest eigenvalue. `across` is the geometric stiffness [1/s^2], of either sign; `held`: Eqs. (4.7), (4.8).
/// The stage equations are solved exactly: Eqs. (3.5), (4.2).
inline double spectral_radius(const RadauTable& table, double across, const std::vector<Gap>& gaps, bool held) {
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  const int n = table.n;
  const double mu = kProjectionShare * table.real_eigenvalue;
  const double hold = held ? std::max(0.0, std::abs(across) - std::pow(table.real_eigenvalue, 2)) : 0;
  double Z = mu * mu + hold, in_stages = across, at_start = across;
  for (const Gap& g : gaps) {
    Z += g.stiffness * g.end * g.end;
    in_stages += g.stiffness * g.stages * g.stages;
    at_start += g.stiffness * g.stages * g.end;
  }
  const MatrixXd A = table.A, A2 = table.A2, matrix = MatrixXd::Identity(n, n) + in_stages * A2;
  const auto answer = [&](const auto& missing) {
    double x = 0, rest = 0;
    for (const Gap& g : gaps) rest += g.stiffness * g.end * missing(g) / Z;
    for (int pass = 0; pass < 3; ++pass, rest *= hold / Z) x += rest;
    return x;
  };
  Eigen::Matrix2d step;
  for (int column = 0; column < 2; ++column) {
    const double x0 = 1 - column, v0 = column;
    const VectorXd a = matrix.partialPivLu().solve(-at_start * (VectorXd::Constant(n, x0) + v0 * VectorXd(table.c)));
    const double moved = A2.row(n - 1).dot(a), gained = A.row(n - 1).dot(a);
    double x = x0 + v0 + moved, v = v0 + gained;
    for (int pass = 0; pass < 2; ++pass) {
      x += answer([&](const Gap& g) { return g.end * (x0 + v0) + g.stages * moved - g.end * x; });
      v += answer([&](const Gap& g) { return g.end * v0 + g.stages * gained - g.end * v; });
    }
    step.col(column) << x, v;
  }
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace pintle::linear_step
