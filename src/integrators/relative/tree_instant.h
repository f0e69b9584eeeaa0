// The equations over a joint tree at one instant: bodies, gaps of the joints that stay force laws, mass matrix, what is
// missing in the balance. theory/tree sections 3 and 5.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "system/joint_tree.h"
#include "system/state.h"

namespace pintle {

/// Coordinates, rates and accelerations of a joint tree, with what is carried of the joints that stay force laws: gap, rate,
/// acceleration and force, three entries for each of `JointTree::laws`.
struct TreeState {
  double t = 0;
  Eigen::VectorXd y, u, w;              // w = u'
  Eigen::VectorXd gap, rate, accel, force;
  std::vector<double> law_state, law_rate;  // of the laws' own states, as in State
};

/// What depends on coordinates and rates beside the laws, at constant accelerations and law forces. theory/tree Eq. (5.4).
struct TreeSlopes {
  Eigen::MatrixXd balance, balance_by_rate;  // of what is missing in the balance
  Eigen::MatrixXd gap, gap_by_rate;          // of the gaps' accelerations
};

class TreeInstant {
 public:
  TreeInstant(const System& system, const JointTree& tree);

  const System& system() const { return system_; }
  const JointTree& tree() const { return tree_; }
  int n() const { return tree_.n(); }
  int n_gaps() const { return 3 * static_cast<int>(tree_.laws().size()); }

  /// Motors that stand at a jump of theirs, from now on; none at first. The list stays the caller's and may change.
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
  /// J' (M a - Q - G' f), at the accelerations given last: what is missing in the balance.
  void imbalance(const Eigen::VectorXd& f, Eigen::VectorXd& out);

  /// The gaps of the geometry. How far surfaces have slipped, and how often belts are wound, it does not know: 0, or what is carried.
  void gaps(Eigen::VectorXd& out, const TreeState* carried = nullptr) const;
  void rates(Eigen::VectorXd& out) const;
  /// Mass matrix, dv/du and A = G J.
  void find_matrices();
  const Eigen::MatrixXd& H() const { return H_; }
  const Eigen::MatrixXd& J() const { return J_; }
  const Eigen::MatrixXd& A() const { return A_; }

  /// At the accelerations given last and the law forces f, after `find_matrices`. Eqs. (5.7), (5.8).
  void slopes(const Eigen::VectorXd& f, TreeSlopes& out);

  /// The tangents of `law` at its part of what the state carries.
  void linearize(int law, const TreeState& at, LawTangents& out) const;
  /// The laws' states as those of joints that have long been as `at` says.
  void rest(TreeState& at) const;
  /// The forces of all laws, and the rates of their states, at what the state carries.
  void forces(const TreeState& at, Eigen::VectorXd& f, std::vector<double>& law_rate) const;
  /// Supplied and lost power [W].
  std::array<double, 2> power(const TreeState& at) const;
  /// The system's switching functions at the carried gaps.
  void evaluate_switching_functions(const TreeState& at, double* value);
  /// System::cross_borders at the carried gaps.
  bool cross_borders(const double* before, const double* after, TreeState& at, double& lost);

  /// Everything of the state but its work, from what is carried; the instant must have been placed at `at`. Accelerations
  /// and the reactions of the tree's joints are those of u' = w.
  void write(const TreeState& at, const Eigen::VectorXd& w, State& state);

 private:
  void find_unbalanced_forces(const Eigen::VectorXd& f);
  void spread_gaps(const TreeState& at);

  const System& system_;
  const JointTree& tree_;
  const std::vector<SlidingMode>* sliding_ = nullptr;
  double t_ = 0;
  TreePose pose_;
  std::vector<JointKinematics> r_;  // of the joints that stay laws
  Vecs Q_, a_, gap_, rate_;
  Vecs on_bodies_;  // what find_unbalanced_forces finds, and other forces of the moment
  Eigen::MatrixXd H_, J_, A_;
  TreeMotionSlopes moved_;
  Eigen::MatrixXd of_forces_, of_forces_by_rate_;  // what the forces on the bodies change by, per coordinate and per rate
  Eigen::MatrixXd geometric_;
};

/// Time, coordinates and their rates of `state`.
void read_coordinates(const JointTree& tree, const State& state, TreeState& out);
/// The carried part of `state`: gaps, rates, accelerations and forces of the joints that stay laws.
void read_carried(const JointTree& tree, const State& state, TreeState& out);

}  // namespace pintle
