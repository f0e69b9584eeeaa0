// Factorizations of dense matrices of any size by Eigen, compiled once: every source that used them directly would take
// seconds longer to compile.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace pintle {

template <class Scalar>
using DenseMatrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using DenseVector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Factors of a square matrix by Eigen's decomposition `Factors`, for solving with one or several right-hand sides.
template <class Factors>
class DenseFactors {
 public:
  using Scalar = typename Factors::Scalar;

  /// Returns false if the matrix (n x n) is not positive definite for `Cholesky`, or if a factor is not finite for `Lu`.
  bool compute(const DenseMatrix<Scalar>& matrix);
  /// x with matrix x = b; b is n x k. Undefined if `compute` returned false.
  template <class Right>
  auto solve(const Eigen::MatrixBase<Right>& b) const {
    if constexpr (Right::ColsAtCompileTime == 1) return solve_vector(b);
    else return solve_matrix(b);
  }

 private:
  DenseVector<Scalar> solve_vector(const DenseVector<Scalar>& b) const;
  DenseMatrix<Scalar> solve_matrix(const DenseMatrix<Scalar>& b) const;

  Factors factors_;
};

using Cholesky = DenseFactors<Eigen::LLT<Eigen::MatrixXd>>;
using Lu = DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXd>>;
using ComplexLu = DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXcd>>;
extern template class DenseFactors<Eigen::LLT<Eigen::MatrixXd>>;
extern template class DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXd>>;
extern template class DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXcd>>;

/// The inverse of a regular matrix.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix);

/// Eigenvalues of a symmetric matrix, in ascending order, and the orthonormal eigenvectors as columns.
class SymmetricEigen {
 public:
  /// Of the lower triangle of the matrix. Returns false if the iteration did not converge.
  bool compute(const Eigen::MatrixXd& matrix);
  const Eigen::VectorXd& eigenvalues() const { return solver_.eigenvalues(); }
  const Eigen::MatrixXd& eigenvectors() const { return solver_.eigenvectors(); }

 private:
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

/// Eigenvalues of a real square matrix, in no order, and the eigenvectors as columns.
class GeneralEigen {
 public:
  enum class Vectors { kLeftOut, kFound };
  /// Returns false if the iteration did not converge.
  bool compute(const Eigen::MatrixXd& matrix, Vectors vectors = Vectors::kFound);
  const Eigen::VectorXcd& eigenvalues() const { return values_; }
  const Eigen::MatrixXcd& eigenvectors() const { return vectors_; }

 private:
  Eigen::VectorXcd values_;
  Eigen::MatrixXcd vectors_;
};

}  // namespace pintle
