// The equations over a joint tree at one instant: bodies, gaps of the joints that remain force laws, mass matrix, residual
// of the balance. theory/tree sections 3 and 5.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "system/joint_tree.h"
#include "system/state.h"

namespace pintle {

/// Coordinates, rates and accelerations of a joint tree, with the carried values of the joints that remain force laws: gap, rate,
/// acceleration and force, three entries for each of `JointTree::laws`.
struct TreeState {
  double t = 0;
  Eigen::VectorXd y, u, w;              // w = u'
  Eigen::VectorXd gap, rate, accel, force;
  std::vector<double> law_state, law_rate;  // of the laws' own states, as in State
};

/// Derivatives by coordinates and rates, except those of the laws, at constant accelerations and law forces. theory/tree Eq. (5.4).
struct TreeSlopes {
  Eigen::MatrixXd balance, balance_by_rate;  // of the residual of the balance
  Eigen::MatrixXd gap, gap_by_rate;          // of the accelerations of the gaps
};

class TreeInstant {
 public:
  TreeInstant(const System& system, const JointTree& tree);

  const System& system() const { return system_; }
  const JointTree& tree() const { return tree_; }
  int n() const { return tree_.n(); }
  int n_gaps() const { return 3 * static_cast<int>(tree_.laws().size()); }

  /// Sets the motors that are held at a jump; initially none. The list remains the caller's and may change.
  void set_sliding(const std::vector<SlidingMode>& sliding) { sliding_ = &sliding; }
  SlidingModes sliding() const { return sliding_ ? SlidingModes(*sliding_) : SlidingModes(); }

  /// Bodies, joint kinematics and external forces.
  void place(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& u);
  /// The same without the external forces.
  void place_only(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& u);
  double t() const { return t_; }
  const TreePose& pose() const { return pose_; }
  const Vecs& Q() const { return Q_; }
  const JointKinematics& kinematics(int law) const { return r_[law]; }

  /// Accelerations of the bodies for u' = w.
  void accelerate(const Eigen::VectorXd& w) { tree_.accelerate(pose_, w, a_); }
  const Vecs& a() const { return a_; }
  /// e'' = G a + bias, at the accelerations given last.
  void gap_accelerations(Eigen::VectorXd& out) const;
  /// J' (M a - Q - G' f), at the accelerations given last: the residual of the balance.
  void imbalance(const Eigen::VectorXd& f, Eigen::VectorXd& out);

  /// The gaps from the geometry, which does not know how far surfaces have slipped and how often belts are wound: 0, or the carried values.
  void gaps(Eigen::VectorXd& out, const TreeState* carried = nullptr) const;
  void rates(Eigen::VectorXd& out) const;
  /// Mass matrix, dv/du and A = G J.
  void find_matrices();
  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::MatrixXd& J() const { return J_; }
  const Eigen::MatrixXd& A() const { return A_; }

  /// At the accelerations given last and the law forces f, after `find_matrices`. Eqs. (5.7), (5.8).
  void slopes(const Eigen::VectorXd& f, TreeSlopes& out);

  /// The tangents of `law` at its part of the carried state.
  void linearize(int law, const TreeState& at, LawTangents& out) const;
  /// Sets the laws' states to those of joints that have long had the gaps and rates of `at`.
  void rest(TreeState& at) const;
  /// The forces of all laws, and the rates of their states, at the carried state.
  void forces(const TreeState& at, Eigen::VectorXd& f, std::vector<double>& law_rate) const;
  /// Supplied and lost power [W].
  std::array<double, 2> power(const TreeState& at) const;
  /// The system's switching functions at the carried gaps.
  void evaluate_switching_functions(const TreeState& at, double* value);
  /// System::cross_borders at the carried gaps.
  bool cross_borders(const double* before, const double* after, TreeState& at, double& lost);

  /// Fills in the state, except its work, from the carried values; the instant must have been placed at `at`. Accelerations
  /// and the reactions of the tree's joints are those for u' = w.
  void write(const TreeState& at, const Eigen::VectorXd& w, State& state);

 private:
  void find_unbalanced_forces(const Eigen::VectorXd& f);
  void spread_gaps(const TreeState& at);

  const System& system_;
  const JointTree& tree_;
  const std::vector<SlidingMode>* sliding_ = nullptr;
  double t_ = 0;
  TreePose pose_;
  std::vector<JointKinematics> r_;  // of the joints that remain laws
  Vecs Q_, a_, gap_, rate_;
  Vecs on_bodies_;  // result of find_unbalanced_forces, and other temporary forces
  Eigen::MatrixXd H_, J_, A_;
  TreeMotionSlopes moved_;
  Eigen::MatrixXd of_forces_, of_forces_by_rate_;  // derivatives of the forces on the bodies by coordinates and by rates
  Eigen::MatrixXd geometric_;
};

/// Time, coordinates and their rates of `state`.
void read_coordinates(const JointTree& tree, const State& state, TreeState& out);
/// The carried part of `state`: gaps, rates, accelerations and forces of the joints that remain laws.
void read_carried(const JointTree& tree, const State& state, TreeState& out);

}  // namespace pintle
