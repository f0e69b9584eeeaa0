#include "mobility/rank.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
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
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> by_rows(G.transpose());  // G' P = Q R: the most independent rows come first
  pivots_ = by_rows.matrixQR().diagonal().cwiseAbs();
  while (rank_ < pivots_.size() && pivots_[rank_] > tolerance * pivots_[0]) ++rank_;
  order_ = by_rows.colsPermutation().indices();
  right_ = by_rows.householderQ() * Eigen::MatrixXd::Identity(n_columns, rank_);
  Eigen::MatrixXd R = by_rows.matrixQR().topRows(rank_).triangularView<Eigen::Upper>();
  R = R * by_rows.colsPermutation().transpose();
  const Eigen::HouseholderQR<Eigen::MatrixXd> across(R.transpose());  // G = left triangle right'
  left_ = across.householderQ() * Eigen::MatrixXd::Identity(n_rows_, rank_);
  triangle_ = across.matrixQR().topRows(rank_);
}

std::vector<int> DenseRank::independent_rows() const { return {order_.data(), order_.data() + rank_}; }

Eigen::MatrixXd DenseRank::dependencies() const {
  return Eigen::MatrixXd::Identity(n_rows_, n_rows_) - left_ * left_.transpose();
}

Eigen::VectorXd DenseRank::free_part(const Eigen::VectorXd& motion) const {
  return motion - right_ * (right_.transpose() * motion);
}

Eigen::VectorXd DenseRank::closing_motion() const {
  return -right_ * triangle_.triangularView<Eigen::Upper>().solve(left_.transpose() * gaps_);
}

SparseRank sparse_rank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance) {
  constexpr double kShift = 1e-11;            // lifts the pivots of dependent rows clear of roundoff
  constexpr double kSmallestPivot = 1e-8;     // well above the pivot that the shift gives a dependent row
  constexpr double kPartOfDependency = 1e-3;  // smaller coefficients are roundoff divided by the shift
  constexpr int kMaxListed = 100;
  SparseRank out;
  const int n_rows = static_cast<int>(rows.size());
  if (n_rows == 0) return out;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n_rows; ++i)
    for_each_entry(rows[i], system, length, [&](int column, double value) { entries.emplace_back(column, i, value); });
  Eigen::SparseMatrix<double> columns(S::kDof * system.n_bodies(), n_rows), shift(n_rows, n_rows);
  columns.setFromTriplets(entries.begin(), entries.end());  // a row of the Jacobian is a column here
  shift.setIdentity();
  const Eigen::SparseMatrix<double> transposed = columns.transpose();
  const Eigen::SparseMatrix<double> gram = transposed * columns + kShift * shift;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(gram);
  if (factors.info() != Eigen::Success) {
    out.rank = -1;
    return out;
  }
  const Eigen::VectorXd pivots = factors.vectorD();
  const double smallest = std::max(kSmallestPivot, tolerance * tolerance);
  for (int i = 0; i < n_rows; ++i) {
    if (pivots[i] > smallest) {
      ++out.rank;
      continue;
    }
    if (static_cast<int>(out.dependencies.size()) == kMaxListed) continue;
    const Eigen::VectorXd ordered = factors.matrixU().solve(Eigen::VectorXd(Eigen::VectorXd::Unit(n_rows, i)));
    const Eigen::VectorXd dependency = factors.permutationPinv() * ordered;
    std::vector<int>& group = out.dependencies.emplace_back();
    for (int row = 0; row < n_rows; ++row)
      if (std::abs(dependency[row]) > kPartOfDependency) group.push_back(row);
  }
  return out;
}

}  // namespace pintle
