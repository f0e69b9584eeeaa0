// GapProjector's questions over a joint tree, with dense matrices: rates moved onto carried gaps, forces balanced with
// the gaps' accelerations, both by degree of stiffness. theory/tree section 6.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "integrators/relative/tree_instant.h"

namespace pintle {

class TreeProjector {
 public:
  /// What the laws weigh with: all that they do, or what keeps the joints together.
  enum class Laws { kWhole, kHolding };

  /// Factorises H and mu^2 + w A H^-1 A' at an instant, w the impedances of the laws at mu. False when singular.
  bool prepare(TreeInstant& at, double mu, const TreeState& laws_at, Laws laws = Laws::kWhole);

  /// The smallest displacements (in the mass norm) whose gap changes are the columns of `wanted`, one pass. Eq. (6.2).
  Eigen::MatrixXd close(const Eigen::MatrixXd& wanted) const;
  /// u' for given forces of the laws, at the instant `at`. The factor of the mass matrix is that of `prepare`.
  void accelerations(TreeInstant& at, const Eigen::VectorXd& force, Eigen::VectorXd& w) const;
  /// Forces for which the accelerations give the gaps' own in the stiff modes, and these accelerations. With `sliding` what no
  /// motion can close is left out. Eq. (6.3).
  void balance(TreeInstant& at, const Eigen::VectorXd& accel, bool sliding, Eigen::VectorXd& force, Eigen::VectorXd& w) const;

 private:
  Eigen::MatrixXd weighted(const Eigen::MatrixXd& x) const;  // row-scaled w x

  Eigen::LLT<Eigen::MatrixXd> mass_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::MatrixXd A_, pull_;       // pull = H^-1 A'
  std::vector<Planar::Mat> weight_;
  Eigen::VectorXd row_;            // scale of the rows
};

}  // namespace pintle
