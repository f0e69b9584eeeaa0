#include "linalg/dense_factors.h"

#include <cmath>
#include <type_traits>

namespace pintle {

template <class Factors>
bool DenseFactors<Factors>::compute(const DenseMatrix<Scalar>& matrix) {
  factors_.compute(matrix);
  if constexpr (std::is_same_v<Factors, Eigen::LLT<Eigen::MatrixXd>>) return factors_.info() == Eigen::Success;
  else return std::isfinite(std::abs(factors_.matrixLU().sum()));
}

template <class Factors>
DenseVector<typename Factors::Scalar> DenseFactors<Factors>::solve_vector(const DenseVector<Scalar>& b) const { return factors_.solve(b); }

template <class Factors>
DenseMatrix<typename Factors::Scalar> DenseFactors<Factors>::solve_matrix(const DenseMatrix<Scalar>& b) const { return factors_.solve(b); }

template class DenseFactors<Eigen::LLT<Eigen::MatrixXd>>;
template class DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXd>>;
template class DenseFactors<Eigen::PartialPivLU<Eigen::MatrixXcd>>;

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) {
  Lu factors;
  factors.compute(matrix);
  return factors.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

bool SymmetricEigen::compute(const Eigen::MatrixXd& matrix) {
  solver_.compute(matrix);
  return solver_.info() == Eigen::Success;
}

bool GeneralEigen::compute(const Eigen::MatrixXd& matrix, Vectors vectors) {
  const bool with_vectors = vectors == Vectors::kFound;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, with_vectors);
  if (solver.info() != Eigen::Success) return false;
  values_ = solver.eigenvalues();
  if (with_vectors) vectors_ = solver.eigenvectors();
  return true;
}

}  // namespace pintle
