// Ideal joints: constraints with Lagrange multipliers, kept on their manifold. theory/ideal.
//
//     M a = Q + G' f,   G a + bias = 0      for the accelerations a and the joint forces f of an instant
//
// G has a row for every gap component that an ideal joint keeps. Joints that are not ideal act by their law. The rows'
// matrix G M^-1 G' is sparse along the joint graph and factorised by LDL'. With redundant rows its eigenvectors are taken,
// as many as there are independent rows: the loops close as well as they can, and the forces are the smallest that do.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "system/state.h"

namespace pintle {

class IdealEquations {
 public:
  /// Takes the rows from JointData::ideal and JointData::redundant.
  explicit IdealEquations(const System& system);

  struct Row {
    int joint, component;
  };
  const std::vector<Row>& rows() const { return rows_; }

  /// Fills in everything of `state` but t, q and v: accelerations, joint forces, gaps (those kept are zero), powers. False
  /// when the rows' matrix cannot be factorised.
  bool complete(State& state);
  /// The shortest displacement, in the mass norm, that closes the gaps, and the same for velocities. False when the loops
  /// cannot be closed, or not from here.
  bool close_positions(double t, Vecs& q);
  bool close_velocities(double t, const Vecs& q, Vecs& v);
  /// Takes from a displacement of q what changes gaps: what is left is shortest in the mass norm from it.
  bool keep_tangential(double t, const Vecs& q, Vecs& displacement);

  /// How independent the rows are: the root of the smallest pivot of their scaled matrix, 1 when they are orthogonal and 0
  /// at a singular position [-].
  double independence(double t, const Vecs& q);
  /// The same at the position last asked about.
  double independence() const;
  /// Takes what redundant rows leave open at the closed position q into account. Call once, before steps.
  void measure_misfit(double t, const Vecs& q);
  /// The rows' combination that is closest to none at all, of unit norm, at the position last asked about.
  Eigen::VectorXd nearest_dependency() const;

 private:
  void read(double t, const Vecs& q, const Vecs& v);
  bool factorize();
  bool factorize_sparse();
  bool find_modes();
  void solve(const Eigen::VectorXd& wanted, Eigen::VectorXd& multipliers) const;
  Eigen::VectorXd rates(const Vecs& x) const;                        // G x
  void push(const Eigen::VectorXd& multipliers, Vecs& x) const;      // x += M^-1 G' multipliers
  void fill_joints(State& state);
  const Eigen::RowVector3d& jacobian(std::size_t row, int side) const { return jacobian_[2 * row + side]; }

  const System& system_;
  std::vector<Row> rows_;
  struct Product {  // of two rows over a body they share
    int entry, row, other, side, other_side, body;
  };
  std::vector<Product> products_;
  Eigen::SparseMatrix<double> matrix_;  // lower half, scaled to a unit diagonal
  std::vector<int> row_of_entry_, column_of_entry_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  std::vector<Eigen::RowVector3d> jacobian_;
  Eigen::VectorXd scale_;
  std::vector<Planar::Motion> m_;
  std::vector<JointKinematics> r_;
  Vecs still_;
  double size_ = 1, smallest_pivot_ = 1, damped_ = 1e-9;
  int n_redundant_ = 0;                 // rows too many, when all are kept
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes_;
};

}  // namespace pintle
