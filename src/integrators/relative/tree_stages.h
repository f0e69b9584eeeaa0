// The stage equations of an implicit step over a joint tree: the unknowns are the accelerations of the coordinates and
// of the carried gaps. theory/tree section 5.
#pragma once

#include <vector>

#include "integrators/absolute/stage_solver.h"
#include "integrators/radau/newton_convergence.h"
#include "integrators/radau/predictor.h"
#include "integrators/radau/radau_table.h"
#include "integrators/relative/tree_instant.h"
#include "linalg/dense_factors.h"

namespace pintle {

/// Accelerations, forces and powers at the nodes {0, c_1 .. c_n} of the last step, one column for each.
struct TreeNodes {
  Eigen::MatrixXd w, accel, force, power;
  Eigen::MatrixXd law_state, law_rate;  // of the laws' own states
};

class TreeStages {
 public:
  TreeStages(const System& system, const JointTree& tree, const RadauTable& table, double tolerance);

  /// Solves the step of h from `begin`. The prediction extrapolates `before`, the previous step of length last_h, if there is one.
  bool solve(const TreeState& begin, double h, const TreeNodes* before, double last_h, const LoadScale& scale, Counters& counters);

  /// Motors that are held at a jump; see TreeInstant.
  void set_sliding(const std::vector<SlidingMode>& sliding);

  const std::vector<TreeState>& states() const { return state_; }
  TreeInstant& instant(int stage) { return at_[stage]; }
  const TreeInstant& instant(int stage) const { return at_[stage]; }
  /// The contraction rate of the last iterations on the stages; 0 if there was only one iteration.
  double contraction() const { return contraction_.seen(); }
  /// Residual of joint j's equation at the end of the step [m/s^2 or rad/s^2].
  double residual(int j) const;

 private:
  void predict(const TreeState& begin, double h, const TreeNodes* before, double last_h);
  void place(const TreeState& begin, double h);
  double find_forces(const LoadScale& scale);
  void find_residuals();
  void linearize();
  bool factorize(double h);
  double correct(const LoadScale& scale);

  template <class Scalar>
  using Matrix = DenseMatrix<Scalar>;
  /// One of the systems into which the equations decouple.
  template <class Scalar>
  struct Mode {
    Scalar mu;
    Matrix<Scalar> pull;  // A' Z(mu)/mu^2
    std::vector<LawImpedance<Scalar>> law;
    Matrix<Scalar> gaps;  // A + E_u/mu + E_y/mu^2
    DenseFactors<Eigen::PartialPivLU<Matrix<Scalar>>> lu;
  };
  template <class Scalar>
  bool factorize(Mode<Scalar>& mode);
  template <class Scalar>
  using Vector = DenseVector<Scalar>;
  template <class Scalar>
  Vector<Scalar> pushes(const Mode<Scalar>& mode, const Vector<Scalar>& missing) const;
  template <class Scalar>
  Vector<Scalar> states_moved(const Mode<Scalar>& mode, const Vector<Scalar>& gaps, const Vector<Scalar>& missing) const;

  const System& system_;
  const JointTree& tree_;
  const RadauTable& table_;
  const int n_;
  double tolerance_;
  NewtonContraction contraction_;
  Predictor predictor_;
  bool relinearizes_;  // there is a law that is linearised again
  std::vector<TreeState> state_;
  std::vector<TreeInstant> at_;
  std::vector<Eigen::VectorXd> missing_, missing_gap_, missing_state_;
  Eigen::VectorXd force_;
  TreeSlopes slopes_;
  std::vector<LawTangents> law_;
  std::vector<double> law_rate_;
  Mode<double> real_;
  std::array<Mode<std::complex<double>>, RadauTable::kMaxPairs> pair_;
};

}  // namespace pintle
