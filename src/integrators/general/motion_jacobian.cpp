#include "integrators/general/motion_jacobian.h"

#include <algorithm>
#include <cmath>

#include "integrators/general/first_order_ode.h"

namespace pintle {

int motion_unknowns(const System& system) { return 6 * system.n_bodies() + system.n_law_states(); }

Eigen::MatrixXd motion_jacobian(const System& system, const State& at) {
  FirstOrderOde ode(system, FirstOrderOde::Energies::kLeftOut);
  std::vector<double> y(static_cast<std::size_t>(ode.size()));
  ode.flatten(at, y.data());
  ode.linearize(at.t, y.data());
  const int half = ode.motion_size() / 2;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(ode.size(), ode.size());
  A.block(0, half, half, half).setIdentity();
  ode.for_each_block([&A](int row, int column, const auto& block) { A.block(row, column, block.rows(), block.cols()) = block; });
  const double w = std::sqrt(std::max(A.block(half, 0, half, half).diagonal().cwiseAbs().maxCoeff(), 1.0));
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(ode.size());
  for (int i = 0; i < system.n_bodies(); ++i) {
    scale.segment<3>(3 * i) = system.bodies[i].mass.cwiseSqrt();
    scale.segment<3>(half + 3 * i) = scale.segment<3>(3 * i) / w;
  }
  return scale.asDiagonal() * A * scale.cwiseInverse().asDiagonal();
}

}  // namespace pintle
