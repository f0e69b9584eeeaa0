#include "integrators/relative/tree_projector.h"

#include <cmath>

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool TreeProjector::prepare(TreeInstant& at, double mu, const TreeState& laws_at, Laws laws, const VectorXd& taut) {
  at.find_matrices();
  if (!mass_.compute(at.H())) return false;
  A_ = at.A();
  const Index m = A_.rows();
  if (m == 0) return true;
  pull_ = mass_.solve(A_.transpose());
  weight_.resize(static_cast<std::size_t>(m / 3));
  LawTangents tangents;
  LawImpedance<double> impedance;
  for (int l = 0; l < static_cast<int>(weight_.size()); ++l) {
    if (laws == Laws::kHolding) {
      const Response held = respond(at.system().joints[at.tree().laws()[l]].law, laws_at.gap.segment<3>(3 * l), laws_at.rate.segment<3>(3 * l));
      weight_[l] = held.stiffness + mu * held.damping;
      continue;
    }
    at.linearize(l, laws_at, tangents);
    impedance.reserve(tangents.n);
    impedance.find_passive(tangents, mu);
    for (int k = 0; k < 9; ++k) weight_[l](k / 3, k % 3) = impedance.weight[k];
  }
  taut_ = taut.size() > 0;
  if (taut_) set_held_mass(at.J(), at.H(), taut / (mu * mu));
  const MatrixXd mobility = A_ * pull_;
  MatrixXd matrix(m, m);
  row_ = VectorXd::Ones(m);
  matrix = weighted(mobility);
  matrix.diagonal().array() += mu * mu;
  row_ = matrix.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
  return lu_.compute(row_.asDiagonal() * matrix);
}

// The mass matrix of (6.4), for the response of the coordinates to gaps.
void TreeProjector::set_held_mass(const MatrixXd& J, const MatrixXd& H, const VectorXd& taut) {
  held_stiffness_ = J.transpose() * taut.asDiagonal() * J;
  held_mass_.compute(H + held_stiffness_);
  pull_ = held_mass_.solve(A_.transpose());
}

MatrixXd TreeProjector::weighted(const MatrixXd& x) const {
  MatrixXd out(x.rows(), x.cols());
  for (Index l = 0; l < x.rows() / 3; ++l) out.middleRows<3>(3 * l) = weight_[l] * x.middleRows<3>(3 * l);
  return row_.asDiagonal() * out;
}

MatrixXd TreeProjector::close(const MatrixXd& wanted) const {
  if (A_.rows() == 0) return MatrixXd::Zero(A_.cols(), wanted.cols());
  MatrixXd x = pull_ * lu_.solve(weighted(wanted)), rest = x;
  for (int pass = 0; pass < kPasses && taut_; ++pass) {
    rest = held_mass_.solve(held_stiffness_ * rest);
    rest -= pull_ * lu_.solve(weighted(A_ * rest));
    x += rest;
  }
  return x;
}

// w A Z^-1 applied to forces on the coordinates, with Z that without `taut`: what a pass leaves in held directions is solved for again.
VectorXd TreeProjector::forces_for(const VectorXd& on_coordinates) const {
  VectorXd sum = VectorXd::Zero(A_.rows()), rest = on_coordinates;
  for (int pass = 0; pass <= kPasses; ++pass) {
    const VectorXd free = held_mass_.solve(rest), more = lu_.solve(weighted(A_ * free));
    sum += more;
    rest = held_stiffness_ * (free - pull_ * more);
  }
  return sum;
}

void TreeProjector::accelerations(TreeInstant& at, const VectorXd& force, VectorXd& w) const {
  at.accelerate(VectorXd::Zero(at.n()));
  at.imbalance(force, w);
  w = mass_.solve(-w);
}

void TreeProjector::balance(TreeInstant& at, const VectorXd& accel, bool held, VectorXd& force, VectorXd& w) const {
  accelerations(at, force, w);
  if (A_.rows() == 0) return;
  VectorXd now;
  at.accelerate(w);
  at.gap_accelerations(now);
  VectorXd missing = accel - now;
  const VectorXd wanted = held ? VectorXd(close(missing)) : VectorXd();
  if (held) missing = A_ * wanted;
  VectorXd more = lu_.solve(weighted(missing));
  if (taut_ && held) more = forces_for(at.H() * wanted);
  force += more;
  w += taut_ ? VectorXd(mass_.solve(A_.transpose() * more)) : VectorXd(pull_ * more);
}

}  // namespace pintle
