// Ideal joints: constraints with Lagrange multipliers, projected onto their manifold, theory/ideal, or constraints with penalties,
// theory/penalty.
//
//     M a = Q + G' f,   G a + bias = 0      for the accelerations a and the joint forces f of an instant
//
// G has a row for every gap component that an ideal joint constrains. Joints that are not ideal act by their law. The rows'
// matrix G M^-1 G' is sparse along the joint graph and factorised by LDL'. With redundant rows its eigenvectors are used,
// as many as there are independent rows: the loops close as well as they can, with the smallest forces that do so.
// A penalty alpha adds 1/alpha to the diagonal, theory/penalty Eq. (1.4). So dependent rows need no special treatment.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <string>
#include <vector>

#include "linalg/dense_factors.h"
#include "pintle/model.h"
#include "system/state.h"

namespace pintle {

/// The force of a joint that keeps its law, including forces from outside. Friction and the like have states, which these equations do
/// not carry.
Planar::Vec force_without_states(const JointData& joint, double t, const JointKinematics& r);
/// Fills in the supplied and lost power of a state that is otherwise complete.
void find_powers(const System& system, const std::vector<Planar::Motion>& m, State& state);

/// Whether this component of the joint's gap is a constraint.
bool is_constrained(const JointData& joint, int component);

class IdealEquations {
 public:
  /// Takes the rows from JointData::ideal and JointData::redundant. `equations`: kIdeal; kPenalty, where penalties give the forces from the
  /// constraints' accelerations, rates and violations; kAugmentedLagrangian, where penalties only serve to find the multipliers.
  explicit IdealEquations(const System& system, Equations equations = Equations::kIdeal, const PenaltySettings& penalty = {});

  struct Row {
    int joint, component;
  };
  const std::vector<Row>& rows() const { return rows_; }

  /// Fills in everything of `state` except t, q and v: accelerations, joint forces, gaps (constrained ones are zero), powers. Returns
  /// false if the rows' matrix cannot be factorised.
  bool complete(State& state);
  /// The part of `complete` that needs no multipliers: gaps, forces of joints that have a law, and in state.a the forces on the bodies including these.
  void find_applied_forces(State& state);
  /// on_bodies += G' f, for the constrained components and the forces that follow from them, at the state of the last `find_applied_forces`.
  void add_constraint_forces(Vecs& force, Vecs& on_bodies) const;
  /// Sets the position and motion at which gaps are taken from now on.
  void look_at(double t, const Vecs& q, const Vecs& v) { read(t, q, v); }
  const Planar::Vec& gap(int joint) const { return r_[joint].gap; }

  /// Closes the gaps by the smallest displacement in the mass norm; the same for velocities. Returns false if the loops
  /// cannot be closed, or not from here.
  bool close_positions(double t, Vecs& q);
  bool close_velocities(double t, const Vecs& q, Vecs& v);
  /// Prepares `project_onto_tangent` at q. Returns false if the rows' matrix cannot be factorised.
  bool find_tangent(double t, const Vecs& q);
  /// Removes from a displacement, at the position last evaluated, the part that changes gaps. What is left is nearest to it in the mass norm.
  void project_onto_tangent(Vecs& displacement) const;
  bool close_accelerations(double t, const Vecs& q, const Vecs& v, Vecs& a);

  /// With penalties: the mass that resists a row, at the first position evaluated, and its penalty [kg or kg*m^2]. theory/penalty Eq. (1.2).
  double resisting_mass(std::size_t row) const { return first_scale_[row] * first_scale_[row]; }
  double penalty(std::size_t row) const { return penalty_.factor * resisting_mass(row); }
  /// Updates the largest violation so far, of lengths [m] and of angles [rad], from the constrained gaps at the position last evaluated.
  void measure_violation();
  /// The violation as a remark on a method.
  std::string violation_text(const std::string& method) const;

  /// How independent the rows are: the root of the smallest pivot of the matrix of orthonormal rows, 1 if they are orthogonal and 0
  /// at a singular position [-].
  double independence(double t, const Vecs& q);
  /// The same at the position last evaluated.
  double independence() const;
  /// Accounts for the gaps that redundant rows leave open at the closed position q. Call once, before any steps.
  void measure_misfit(double t, const Vecs& q);
  /// Takes over the misfit that other equations of the same system have measured.
  void take_misfit(const IdealEquations& other) { damped_ = other.damped_; }
  /// The combination of rows, of unit norm, that is closest to zero, at the position last evaluated.
  Eigen::VectorXd nearest_dependency() const;

 private:
  void read(double t, const Vecs& q, const Vecs& v);
  struct JointRows {
    int first, n;
    Eigen::Matrix3d lower;  // of n rows: L with L L' = G M^-1 G' of the joint alone
  };
  void orthonormalize_rows();
  bool factorize();
  bool has_penalties() const { return equations_ != Equations::kIdeal; }
  bool factorize_sparse();
  bool factorize_with_penalties();
  bool find_modes();
  Eigen::VectorXd to_orthonormal_rows(Eigen::VectorXd x) const;
  Eigen::VectorXd from_orthonormal_rows(const Eigen::VectorXd& y) const;
  Eigen::VectorXd to_multipliers(Eigen::VectorXd y) const;
  void solve(const Eigen::VectorXd& wanted, Eigen::VectorXd& multipliers) const;
  Eigen::VectorXd rates(const Vecs& x) const;                        // G x
  void push(const Eigen::VectorXd& multipliers, Vecs& x) const;      // x += M^-1 G' multipliers
  void fill_joints(State& state);
  void find_reactions(State& state) const;
  bool find_reaction_dependent_forces(const Vecs& applied, State& state) const;
  Eigen::VectorXd reactions_to_unit_opening_force(int joint) const;
  void accelerate(int joint, const Planar::Vec& force, Vecs& a) const;  // a += M^-1 G' force
  Eigen::VectorXd add_reactions(Vecs& a) const;                      // a += M^-1 G' f; f
  const Eigen::RowVector3d& jacobian(std::size_t row, int side) const { return jacobian_[2 * row + side]; }

  const System& system_;
  struct Teeth {
    int joint, row;
  };
  std::vector<Teeth> teeth_;     // ideal joints with a force that follows from the reaction of a row: teeth with a pressure angle
  Equations equations_;
  PenaltySettings penalty_;
  std::vector<Row> rows_;
  struct Product {  // of two rows, through a body they share
    int entry, row, other, side, other_side, body;
  };
  std::vector<Product> products_;
  Eigen::SparseMatrix<double> matrix_;  // lower half, of orthonormal rows
  std::vector<int> row_of_entry_, column_of_entry_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  std::vector<Eigen::RowVector3d> jacobian_, orthonormal_;
  std::vector<JointRows> joint_rows_;
  Eigen::VectorXd first_scale_;  // with penalties: roots of the masses that resist the rows at the first position
  std::array<double, 2> violation_{};
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
  Vecs still_;
  double size_ = 1, smallest_pivot_ = 1, damped_ = 1e-9;
  int n_redundant_ = 0;                 // number of redundant rows, if all rows are kept
  SymmetricEigen modes_;
};

/// Projects the positions and velocities of a start onto the constraints, regardless of what enforces these afterwards.
bool close_loops(const System& system, State& state);

}  // namespace pintle
