#include "analyses/check_rank.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SVD>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pintle {
namespace {

using S = Planar;

double scaled_norm(const ConstraintRow& row, const Placement& at, double length) {
  double sum = 0;
  const auto add = [&](int body, const Eigen::RowVector3d& g) {
    if (body != kGround) sum += g.head<2>().squaredNorm() + g[2] * g[2] / (length * length);
  };
  add(at.a, row.on_a);
  add(at.b, row.on_b);
  return sum > 0 ? std::sqrt(sum) : 1;
}

// Calls put(column, value) for each entry of a scaled row.
template <class Put>
void for_each_entry(const ConstraintRow& row, const System& system, double length, Put&& put) {
  const Placement& at = system.joints[row.joint].at;
  const double scale = 1 / scaled_norm(row, at, length);
  for (const auto& [body, g] : {std::pair{at.a, &row.on_a}, std::pair{at.b, &row.on_b}}) {
    if (body == kGround) continue;
    for (int k = 0; k < S::kDof; ++k) put(S::kDof * body + k, (*g)[k] * scale / (k == 2 ? length : 1));
  }
}

}  // namespace

DenseRank::DenseRank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance)
    : n_rows_(static_cast<int>(rows.size())) {
  const int n_columns = S::kDof * system.n_bodies();
  gaps_.resize(n_rows_);
  if (n_rows_ == 0 || n_columns == 0) {
    left_.resize(n_rows_, 0);
    right_.resize(n_columns, 0);
    return;
  }
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n_rows_, n_columns);
  for (int i = 0; i < n_rows_; ++i) {
    for_each_entry(rows[i], system, length, [&](int column, double value) { G(i, column) += value; });
    gaps_[i] = rows[i].gap / scaled_norm(rows[i], system.joints[rows[i].joint].at, length);
  }
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(G, Eigen::ComputeThinU | Eigen::ComputeThinV);
  values_ = svd.singularValues();
  while (rank_ < values_.size() && values_[rank_] > tolerance * values_[0]) ++rank_;
  left_ = svd.matrixU().leftCols(rank_);
  right_ = svd.matrixV().leftCols(rank_);
}

Eigen::MatrixXd DenseRank::dependencies() const {
  return Eigen::MatrixXd::Identity(n_rows_, n_rows_) - left_ * left_.transpose();
}

Eigen::VectorXd DenseRank::free_part(const Eigen::VectorXd& motion) const {
  return motion - right_ * (right_.transpose() * motion);
}

Eigen::VectorXd DenseRank::closing_motion() const {
  return -right_ * (left_.transpose() * gaps_).cwiseQuotient(values_.head(rank_));
}

SparseRank sparse_rank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance) {
  constexpr double kPartOfDependency = 1e-6;  // smaller coefficients are rounding
  constexpr int kMaxListed = 100;
  SparseRank out;
  const int n_rows = static_cast<int>(rows.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n_rows; ++i)
    for_each_entry(rows[i], system, length, [&](int column, double value) { entries.emplace_back(column, i, value); });
  Eigen::SparseMatrix<double> columns(S::kDof * system.n_bodies(), n_rows);  // a row of the Jacobian is a column here
  columns.setFromTriplets(entries.begin(), entries.end());
  columns.makeCompressed();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr;
  qr.setPivotThreshold(tolerance);
  qr.compute(columns);
  out.rank = static_cast<int>(qr.rank());
  const Eigen::SparseMatrix<double> R = qr.matrixR();
  const auto upper = R.topLeftCorner(out.rank, out.rank).template triangularView<Eigen::Upper>();
  const auto& order = qr.colsPermutation().indices();  // column c of the factor is row order[c]
  for (int c = out.rank; c < std::min(n_rows, out.rank + kMaxListed); ++c) {
    const Eigen::VectorXd dependent = R.col(c).head(out.rank);
    const Eigen::VectorXd x = upper.solve(dependent);
    std::vector<int>& group = out.dependencies.emplace_back();
    group.push_back(order[c]);
    for (int i = 0; i < out.rank; ++i)
      if (std::abs(x[i]) > kPartOfDependency) group.push_back(order[i]);
  }
  return out;
}

}  // namespace pintle
