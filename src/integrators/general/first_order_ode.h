// A system as the plain first-order equations y' = f(t, y) that general integrators need, with the exact Jacobian:
// y = (q, v, z), with z the laws' own states, and optionally the energies dissipated and supplied as two more components. theory/solvers section 1.
#pragma once

#include "integrators/force_evaluator.h"
#include "integrators/general/force_tangents.h"

namespace pintle {

class FirstOrderOde {
 public:
  enum class Energies { kLeftOut, kAppended };

  FirstOrderOde(const System& system, Energies energies);

  const System& system() const { return system_; }
  /// Length of y, and of its part (q, v).
  int size() const { return state_size() + (energies_ ? 2 : 0); }
  int motion_size() const { return 6 * system_.n_bodies(); }
  /// Length of (q, v, z).
  int state_size() const { return motion_size() + system_.n_law_states(); }
  void flatten(const State& state, double* y) const;
  /// Fills in time, q, v and, if y has them, the energies of `state`; the rest is unchanged.
  void unflatten(double t, const double* y, State& state) const;

  /// The switching functions, if some law changes its states at a border; otherwise none.
  int n_roots() const { return n_roots_; }
  void find_roots(double t, const double* y, double* value);

  /// f(t, y); returns false if it is not finite.
  bool rate(double t, const double* y, double* dy);
  /// Finds the blocks of d(a)/dq and d(a)/dv at y. The energies' rows of the Jacobian are taken as zero: nothing depends
  /// on the energies.
  void linearize(double t, const double* y);
  /// A body whose accelerations may depend on the coordinates of another, and the place of the block.
  struct Coupling {
    int row, place;
  };
  /// Calls put(row, column, block) for every block of the Jacobian of (q, v, z) at the last `linearize`, except that q' = v.
  template <class Put>
  void for_each_block(Put&& put) const;
  /// All bodies that depend on the coordinates of body `column`, in the order of rows.
  const std::vector<Coupling>& couplings(int column) const { return couplings_[column]; }
  Planar::Mat by_position(const Coupling& c) const { return inverse_mass(c.row) * tangents_.by_position(c.place); }
  Planar::Mat by_velocity(const Coupling& c) const { return inverse_mass(c.row) * tangents_.by_velocity(c.place); }
  /// Joints whose laws have states, and the derivatives of the accelerations of one's body `side` (0 or 1) by its states: 3 x n.
  const std::vector<ForceTangents::StateTangents>& states() const { return tangents_.states(); }
  Eigen::MatrixXd accelerations_by_state(const ForceTangents::StateTangents& at, int side) const;
  /// Derivatives of the rates of the states by a body's positions, or velocities: n x 3.
  static Eigen::MatrixXd rates_by_motion(const ForceTangents::StateTangents& at, int side, bool velocities);

 private:
  Eigen::DiagonalMatrix<double, 3> inverse_mass(int i) const { return Eigen::DiagonalMatrix<double, 3>(system_.bodies[i].mass.cwiseInverse()); }

  const System& system_;
  bool energies_;
  ForceEvaluator force_evaluator_;
  ForceTangents tangents_;
  State at_;
  int n_roots_ = 0;
  std::vector<std::vector<Coupling>> couplings_;  // by columns
};

template <class Put>
void FirstOrderOde::for_each_block(Put&& put) const {
  const int half = motion_size() / 2;
  for (int j = 0; j < system_.n_bodies(); ++j)
    for (const Coupling& at : couplings(j)) {
      put(half + 3 * at.row, 3 * j, by_position(at));
      put(half + 3 * at.row, half + 3 * j, by_velocity(at));
    }
  for (const ForceTangents::StateTangents& of : states()) {
    const JointData& joint = system_.joints[of.joint];
    const int first = 2 * half + joint.first_state;
    for (int side = 0; side < 2; ++side) {
      const int body = side == 0 ? joint.at.a : joint.at.b;
      if (body == kGround) continue;
      put(half + 3 * body, first, accelerations_by_state(of, side));
      for (const bool velocities : {false, true}) put(first, (velocities ? half : 0) + 3 * body, rates_by_motion(of, side, velocities));
    }
    Eigen::MatrixXd by_state(of.law.n, of.law.n);
    for (int r = 0; r < of.law.n; ++r)
      for (int c = 0; c < of.law.n; ++c) by_state(r, c) = of.law.by_state[r][c];
    put(first, first, by_state);
  }
}

}  // namespace pintle
