// GapProjector's counterpart over a joint tree, with dense matrices: projects rates onto carried gaps and balances forces
// with the gaps' accelerations, both by degree of stiffness. theory/tree section 6.
#pragma once

#include "integrators/relative/tree_instant.h"
#include "linalg/dense_factors.h"

namespace pintle {

class TreeProjector {
 public:
  /// Which part of the laws gives the weights: all of it, or only what holds the joints together.
  enum class Laws { kWhole, kHolding };

  /// Factorises H and mu^2 + w A H^-1 A' at an instant, with w the impedances of the laws at mu. Returns false if singular. `taut` has the
  /// stiffnesses that hold the bodies' coordinates, three for each body, or is empty. With it, `close` and `balance` use H + J' taut J / mu^2
  /// in place of H, and repeat the solution for what that leaves.
  bool prepare(TreeInstant& at, double mu, const TreeState& laws_at, Laws laws = Laws::kWhole, const Eigen::VectorXd& taut = {});

  /// The smallest displacements (in the mass norm) whose gap changes are the columns of `wanted`, one pass. Eq. (6.2).
  Eigen::MatrixXd close(const Eigen::MatrixXd& wanted) const;
  /// u' for given forces of the laws, at the instant `at`, with the factors of the mass matrix from `prepare`.
  void accelerations(TreeInstant& at, const Eigen::VectorXd& force, Eigen::VectorXd& w) const;
  /// Forces whose accelerations agree with the gaps' own in the stiff modes, and these accelerations. With `held`, what no
  /// motion can close is left out. Eq. (6.3).
  void balance(TreeInstant& at, const Eigen::VectorXd& accel, bool held, Eigen::VectorXd& force, Eigen::VectorXd& w) const;

 private:
  Eigen::MatrixXd weighted(const Eigen::MatrixXd& x) const;  // row-scaled w x
  void set_held_mass(const Eigen::MatrixXd& J, const Eigen::MatrixXd& H, const Eigen::VectorXd& taut);
  Eigen::VectorXd forces_for(const Eigen::VectorXd& on_coordinates) const;
  static constexpr int kPasses = 2;  // passes of the projection, after the first, if bodies are held

  Cholesky mass_;
  Lu lu_;
  Eigen::MatrixXd A_, pull_;       // pull = H^-1 A'
  bool taut_ = false;              // bodies are held
  Cholesky held_mass_;
  Eigen::MatrixXd held_stiffness_;        // J' taut J / mu^2
  std::vector<Planar::Mat> weight_;
  Eigen::VectorXd row_;            // scale of the rows
};

}  // namespace pintle
