// A block matrix on a fixed pattern, factorised in place along the pattern's order. No pivoting across blocks: the
// matrices of this program are dominated by their mass and stiffness blocks. No allocation after construction.
#pragma once

#include <utility>
#include <vector>

#include "linalg/block.h"
#include "linalg/block_pattern.h"
#include "simd/fetch.h"

namespace pintle {

/// Whether only the upper triangle of a matrix is stored and eliminated: it is the lower one's transpose (not its conjugate).
enum class Symmetry { kNone, kSymmetric };

template <class T, int N>
class BlockLu {
 public:
  BlockLu() = default;
  explicit BlockLu(const BlockPattern& pattern, Symmetry symmetry = Symmetry::kNone)
      : pattern_(&pattern), symmetric_(symmetry == Symmetry::kSymmetric), diagonal_(pattern.n()), upper_(pattern.n_off_diagonal()),
        lower_(symmetric_ ? 0 : pattern.n_off_diagonal()), row_(symmetric_ ? pattern.longest_row() : 0), row_swaps_(symmetric_ ? 0 : pattern.n()) {}

  bool symmetric() const { return symmetric_; }
  /// Sets the matrix to a diagonal one: entry(i, k) at place k of row i.
  template <class Entry>
  void set_diagonal(Entry&& entry) {
    for (int i = 0; i < pattern_->n(); ++i) set_diagonal(i, [&](int k) { return entry(i, k); });
  }
  /// The same for row i alone, and the column below it.
  template <class Entry>
  PINTLE_LANES void set_diagonal(int i, Entry&& entry) {
    const int at = pattern_->position(i), end = pattern_->first(at + 1);
    Block<T, N>& block = diagonal_[at];
    for (int r = 0; r < N; ++r) {
      const T here = entry(r);
      for (int c = 0; c < N; ++c) block(r, c) = r == c ? here : T(0.0);
    }
    for (int a = pattern_->first(at); a < end; ++a) {
      clear(upper_[a]);
      if (!symmetric_) clear(lower_[a]);
    }
  }
  /// The diagonal block of row i; in a symmetric matrix the part above its diagonal is not read.
  Block<T, N>& diagonal(int i) { return diagonal_[pattern_->position(i)]; }
  /// Whether this block is stored: a symmetric matrix has only the upper triangle.
  bool has(BlockPattern::Slot s) const { return s.upper || !symmetric_; }
  /// An off-diagonal block by its slot; the opposite order of rows gives the other triangle.
  Block<T, N>& off_diagonal(BlockPattern::Slot s) { return s.upper ? upper_[s.index] : lower_[s.index]; }
  Block<T, N>& upper_at(int index) { return upper_[index]; }
  Block<T, N>& lower_at(int index) { return lower_[index]; }

  /// Factorises in place; false when a pivot block is singular.
  bool factorize() {
    for (int k = 0; k < pattern_->n(); ++k)
      if (!(symmetric_ ? eliminate_upper(k) : eliminate_both(k))) return false;
    return true;
  }

  /// Solves in place, rows in the user's numbering. A row holds N numbers like T, or several side by side for as many
  /// right-hand sides.
  template <class Rows>
  void solve(Rows& x) const {
    solve(x, [](int, const auto&) {});
  }
  /// The same; last(i, x[i]) is called as soon as row i is known, though others still read it.
  template <class Rows, class Last>
  void solve(Rows& x, Last&& last) const {
    reduce(0, pattern_->n(), x, [](int, auto&) {});
    substitute(0, pattern_->n(), x, last);
  }
  /// Factorises and solves, in one forward and one backward pass through the rows. False when a pivot block is singular.
  template <class Rows>
  bool factorize_and_solve(Rows& x) {
    if (!eliminate(0, pattern_->n(), x, [](int, auto&) {})) return false;
    substitute(0, pattern_->n(), x, [](int, const auto&) {});
    return true;
  }

  /// The number of rows of the order that can be eliminated once rows [0, n) are filled.
  int ready(int n, int from) const {
    const BlockPattern& p = *pattern_;
    for (; from < n; ++from)
      if (p.first(from) < p.first(from + 1) && p.column(p.first(from + 1) - 1) >= n) break;
    return from;
  }
  /// The forward pass through rows [from, to) of the order, which must be ready: factorises them and reduces their right-hand
  /// sides. first(i, x[i]) is called before any use of row i's, though other rows may already have been subtracted from it. False
  /// when a pivot block is singular.
  template <class Rows, class First>
  PINTLE_LANES bool eliminate(int from, int to, Rows& x, First&& first) {
    return symmetric_ ? eliminate_rows<true>(from, to, x, first) : eliminate_rows<false>(from, to, x, first);
  }
  /// The same for right-hand sides alone, with rows already factorised.
  template <class Rows, class First>
  PINTLE_LANES void reduce(int from, int to, Rows& x, First&& first) const {
    for (int k = from; k < to; ++k) {
      if (symmetric_) reduce_row<true>(k, x, first);
      else reduce_row<false>(k, x, first);
    }
  }
  /// The backward pass through rows [from, to), after the later rows; last(i, x[i]) as in solve.
  template <class Rows, class Last>
  PINTLE_LANES void substitute(int from, int to, Rows& rows, Last&& last) const {
    if (symmetric_) substitute_rows<true>(from, to, rows, last);
    else substitute_rows<false>(from, to, rows, last);
  }

  /// Row k of the order will be filled or eliminated soon.
  PINTLE_LANES void fetch_row(int k) const {
    if (k >= pattern_->n()) return;
    fetch(diagonal_, k);
    fetch_upper(k);
    if (!symmetric_) fetch(lower_, pattern_->first(k), pattern_->first(k + 1) - pattern_->first(k));
  }
  /// Row k will be substituted soon.
  PINTLE_LANES void fetch_upper(int k) const {
    if (k >= 0) fetch(upper_, pattern_->first(k), pattern_->first(k + 1) - pattern_->first(k));
  }

 private:
  PINTLE_LANES static void clear(Block<T, N>& block) {
    for (int r = 0; r < N; ++r)
      for (int c = 0; c < N; ++c) block(r, c) = T(0.0);
  }

  // Pivot blocks Z are P' L D U. What stands beside them becomes that of a triangular factorisation of the whole matrix: L^-1 P above the diagonal, U^-1 D^-1 below.
  PINTLE_LANES bool eliminate_both(int k) {
    const BlockPattern& p = *pattern_;
    if (!factorize_pivoted(diagonal_[k], row_swaps_[k])) return false;
    const int begin = p.first(k), end = p.first(k + 1);
    const int* target = p.updates(k);
    for (int a = begin; a < end; ++a) solve_lower(diagonal_[k], row_swaps_[k], upper_[a]);
    for (int a = begin; a < end; ++a) {
      solve_upper_from_right(diagonal_[k], lower_[a]);
      for (int b = begin; b < end; ++b, ++target) {
        Block<T, N>& block = *target == 0  ? diagonal_[p.column(a)]
                             : *target > 0 ? upper_[*target - 1]
                                           : lower_[-*target - 1];
        subtract_product(block, lower_[a], upper_[b]);
      }
    }
    return true;
  }

  // Pivot blocks Z are L D L', and the blocks above the diagonal become Z^-1 U: in a solve each row waits only for one product with
  // the previous row.
  PINTLE_LANES bool eliminate_upper(int k) {
    const BlockPattern& p = *pattern_;
    Block<T, N>*const diagonal = diagonal_.data(), *const upper = upper_.data(), *const row = row_.data();  // no store reaches these
    Block<T, N>& pivot = diagonal[k];
    if (!factorize_symmetric(pivot)) return false;
    const int begin = p.first(k), end = p.first(k + 1);
    const int* target = p.updates(k);
    for (int a = begin; a < end; ++a) {
      apply_lower(pivot, upper[a]);
      row[a - begin] = over_pivots(pivot, upper[a]);
    }
    for (int a = begin; a < end; ++a)
      for (int b = begin; b < end; ++b, ++target) {
        if (*target == 0) subtract_symmetric_product(diagonal[p.column(a)], upper[a], row[a - begin]);
        else if (*target > 0) subtract_transposed_product(upper[*target - 1], upper[a], row[b - begin]);
      }
    for (int a = begin; a < end; ++a) {
      apply_lower_transposed(pivot, row[a - begin]);
      upper[a] = row[a - begin];
    }
    return true;
  }

  template <bool kSymmetric, class Rows, class First>
  PINTLE_LANES bool eliminate_rows(int from, int to, Rows& x, First& first) {
    for (int k = from; k < to; ++k) {
      if (!(kSymmetric ? eliminate_upper(k) : eliminate_both(k))) return false;
      reduce_row<kSymmetric>(k, x, first);
    }
    return true;
  }

  // Row k in the forward pass.
  template <bool kSymmetric, class Rows, class First>
  PINTLE_LANES void reduce_row(int k, Rows& x, First& first) const {
    const BlockPattern& p = *pattern_;
    const int i = p.row_at(k), end = p.first(k + 1);
    auto& here = x[i];
    first(i, here);
    if constexpr (!kSymmetric) solve_lower(diagonal_[k], row_swaps_[k], here);
    for (int a = p.first(k); a < end; ++a) {
      auto& there = x[p.row_at(p.column(a))];
      if constexpr (kSymmetric) subtract_transposed_product(there, upper_[a], here);
      else subtract_product(there, lower_[a], here);
    }
    if constexpr (kSymmetric) apply_inverse(diagonal_[k], here);
  }

  template <bool kSymmetric, class Rows, class Last>
  PINTLE_LANES void substitute_rows(int from, int to, Rows& rows, Last& last) const {
    const BlockPattern& p = *pattern_;
    const Block<T, N>* const upper = upper_.data();  // no store reaches these
    const auto x = rows.data();
    for (int k = to - 1; k >= from; --k) {
      const int i = p.row_at(k), end = p.first(k + 1);
      auto& here = x[i];
      for (int a = p.first(k); a < end; ++a) subtract_product(here, upper[a], x[p.row_at(p.column(a))]);
      if constexpr (!kSymmetric) solve_upper(diagonal_[k], here);
      last(i, std::as_const(here));
    }
  }

  const BlockPattern* pattern_ = nullptr;
  bool symmetric_ = false;
  std::vector<Block<T, N>> diagonal_, upper_, lower_;
  std::vector<Block<T, N>> row_;  // of the pivot
  std::vector<RowSwaps<N>> row_swaps_;
};

}  // namespace pintle
