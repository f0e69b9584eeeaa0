// The rank of the constraint Jacobian, what its rows say twice, and which way the mechanism can still go.
//
// Columns are scaled so that an angle counts as the path of a typical arm (angle times `length`), rows to unit norm. A
// singular value below `tolerance` times the largest counts as zero.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mobility/constraint_rows.h"

namespace pintle {

/// By singular values: exact about shares and directions, cubic in the size.
class DenseRank {
 public:
  DenseRank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance);

  int rank() const { return rank_; }
  double smallest_kept() const { return rank_ > 0 ? values_[rank_ - 1] / values_[0] : 0; }
  double largest_dropped() const { return rank_ < values_.size() && values_[0] > 0 ? values_[rank_] / values_[0] : 0; }
  /// Projector onto the rows' dependencies (left null space); its diagonal adds up to the number of redundant rows.
  Eigen::MatrixXd dependencies() const;
  /// As many independent rows as the rank, the most independent ones first.
  std::vector<int> independent_rows() const;
  /// The part of a motion that no row resists. Scaled columns.
  Eigen::VectorXd free_part(const Eigen::VectorXd& motion) const;
  /// The shortest motion that closes the rows' gaps. Scaled columns.
  Eigen::VectorXd closing_motion() const;

 private:
  Eigen::MatrixXd jacobian_;      // scaled
  Eigen::MatrixXd left_, right_;  // singular vectors that count
  Eigen::VectorXd values_, gaps_;
  int n_rows_ = 0, rank_ = 0;
};

/// By the pivots of G G' (L D L', sparse): for large mechanisms. -1: the factorisation failed.
struct SparseRank {
  int rank = 0;
  std::vector<std::vector<int>> dependencies;  // groups of rows that are bound by one dependency each; the first 100
};
SparseRank sparse_rank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance);

}  // namespace pintle
