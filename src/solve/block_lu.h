// A block matrix on a fixed pattern, factorised in place along the pattern's order. No pivoting across blocks: the
// matrices of this program are dominated by their mass and stiffness blocks. No allocation after construction.
#pragma once

#include <vector>

#include "solve/block.h"
#include "solve/block_pattern.h"

namespace pintle {

template <class T, int N>
class BlockLu {
 public:
  BlockLu() = default;
  explicit BlockLu(const BlockPattern& pattern)
      : pattern_(&pattern), diagonal_(pattern.n()), upper_(pattern.n_off_diagonal()), lower_(pattern.n_off_diagonal()) {}

  void set_zero() {
    diagonal_.assign(diagonal_.size(), {});
    upper_.assign(upper_.size(), {});
    lower_.assign(lower_.size(), {});
  }
  /// The diagonal block of row i.
  Block<T, N>& diagonal(int i) { return diagonal_[pattern_->position(i)]; }
  /// An off-diagonal block by its slot; transposed order of rows gives the other triangle.
  Block<T, N>& off_diagonal(BlockPattern::Slot s) { return s.upper ? upper_[s.index] : lower_[s.index]; }
  Block<T, N>& diagonal_at(int position) { return diagonal_[position]; }
  Block<T, N>& upper_at(int index) { return upper_[index]; }
  Block<T, N>& lower_at(int index) { return lower_[index]; }

  /// Factorises in place; false when a pivot block is singular.
  bool factorize() {
    const BlockPattern& p = *pattern_;
    for (int k = 0; k < p.n(); ++k) {
      if (!invert(diagonal_[k])) return false;
      const int begin = p.first(k), end = p.first(k + 1);
      const int* target = p.updates(k);
      for (int a = begin; a < end; ++a) {
        lower_[a] = product(lower_[a], diagonal_[k]);
        for (int b = begin; b < end; ++b, ++target) {
          Block<T, N>& block = *target == 0  ? diagonal_[p.column(a)]
                               : *target > 0 ? upper_[*target - 1]
                                             : lower_[-*target - 1];
          subtract_product(block, lower_[a], upper_[b]);
        }
      }
    }
    return true;
  }

  /// Solves in place, rows in the user's numbering. U is T, or several numbers side by side for as many right-hand sides.
  template <class U>
  void solve(std::vector<BlockVec<U, N>>& x) const {
    const BlockPattern& p = *pattern_;
    for (int k = 0; k < p.n(); ++k) {
      const BlockVec<U, N>& done = x[p.row_at(k)];
      for (int a = p.first(k); a < p.first(k + 1); ++a) subtract_product(x[p.row_at(p.column(a))], lower_[a], done);
    }
    for (int k = p.n() - 1; k >= 0; --k) {
      BlockVec<U, N>& here = x[p.row_at(k)];
      for (int a = p.first(k); a < p.first(k + 1); ++a) subtract_product(here, upper_[a], x[p.row_at(p.column(a))]);
      here = product(diagonal_[k], here);
    }
  }

 private:
  const BlockPattern* pattern_ = nullptr;
  std::vector<Block<T, N>> diagonal_, upper_, lower_;
};

}  // namespace pintle
