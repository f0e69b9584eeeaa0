// The rank of the constraint Jacobian, the dependencies of its rows, and the directions in which the mechanism is free.
//
// Columns are scaled so that an angle counts as the displacement at a typical arm (angle times `length`), rows to unit
// norm. A pivot below `tolerance` times the largest counts as zero.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mobility/constraint_rows.h"

namespace pintle {

/// By orthogonal factors, G = left triangle right' with the pivots of a column-pivoted QR decomposition: shares and directions are exact, the cost is
/// cubic in the size. The pivots are close to the singular values.
class DenseRank {
 public:
  DenseRank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance);

  int rank() const { return rank_; }
  double smallest_kept() const { return rank_ > 0 ? pivots_[rank_ - 1] / pivots_[0] : 0; }
  double largest_dropped() const { return rank_ < pivots_.size() && pivots_[0] > 0 ? pivots_[rank_] / pivots_[0] : 0; }
  /// Projector onto the rows' dependencies (left null space); its diagonal adds up to the number of redundant rows.
  Eigen::MatrixXd dependencies() const;
  /// As many independent rows as the rank, the most independent ones first.
  std::vector<int> independent_rows() const;
  /// The part of a motion that no row resists. Scaled columns.
  Eigen::VectorXd free_part(const Eigen::VectorXd& motion) const;
  /// The shortest motion that closes the rows' gaps. Scaled columns.
  Eigen::VectorXd closing_motion() const;

 private:
  Eigen::MatrixXd left_, triangle_, right_;  // of the part above the tolerance
  Eigen::VectorXd pivots_, gaps_;
  Eigen::VectorXi order_;                    // of the rows, the most independent ones first
  int n_rows_ = 0, rank_ = 0;
};

/// By the pivots of G G' (L D L', sparse): for large mechanisms. -1: the factorisation failed.
struct SparseRank {
  int rank = 0;
  std::vector<std::vector<int>> dependencies;  // groups of rows, one for each dependency; the first 100
};
SparseRank sparse_rank(const std::vector<ConstraintRow>& rows, const System& system, double length, double tolerance);

}  // namespace pintle
