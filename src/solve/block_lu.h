// A block matrix on a fixed pattern, factorised in place along the pattern's order. No pivoting across blocks: the
// matrices of this program are dominated by their mass and stiffness blocks. No allocation after construction.
#pragma once

#include <utility>
#include <vector>

#include "solve/block.h"
#include "solve/block_pattern.h"

namespace pintle {

/// Whether only the upper triangle of a matrix is stored and eliminated: it is the lower one's transpose (not its conjugate).
enum class Symmetry { kNone, kSymmetric };

template <class T, int N>
class BlockLu {
 public:
  BlockLu() = default;
  explicit BlockLu(const BlockPattern& pattern, Symmetry symmetry = Symmetry::kNone)
      : pattern_(&pattern), symmetric_(symmetry == Symmetry::kSymmetric), diagonal_(pattern.n()), upper_(pattern.n_off_diagonal()),
        lower_(symmetric_ ? 0 : pattern.n_off_diagonal()), row_(symmetric_ ? pattern.longest_row() : 0) {}

  bool symmetric() const { return symmetric_; }
  /// Nothing but its diagonal: entry(i, k) at place k of row i.
  template <class Entry>
  void set_diagonal(Entry&& entry) {
    for (int i = 0; i < pattern_->n(); ++i) set_diagonal(i, [&](int k) { return entry(i, k); });
  }
  /// The same of row i alone, and of the column below it.
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
  /// The diagonal block of row i; of a symmetric matrix what stands above its diagonal is not read.
  Block<T, N>& diagonal(int i) { return diagonal_[pattern_->position(i)]; }
  /// Whether this block is one of the matrix: a symmetric one has only the upper triangle.
  bool has(BlockPattern::Slot s) const { return s.upper || !symmetric_; }
  /// An off-diagonal block by its slot; transposed order of rows gives the other triangle.
  Block<T, N>& off_diagonal(BlockPattern::Slot s) { return s.upper ? upper_[s.index] : lower_[s.index]; }
  Block<T, N>& diagonal_at(int position) { return diagonal_[position]; }
  Block<T, N>& upper_at(int index) { return upper_[index]; }
  Block<T, N>& lower_at(int index) { return lower_[index]; }

  /// Factorises in place; false when a pivot block is singular.
  bool factorize() { return symmetric_ ? factorize_upper() : factorize_both(); }

  /// Solves in place, rows in the user's numbering. What a row holds is N numbers like T, or several side by side for as many
  /// right-hand sides.
  template <class Rows>
  void solve(Rows& x) const {
    solve(x, [](int, auto&) {}, [](int, const auto&) {});
  }
  /// The same on the way through the rows: first(i, x[i]) is called before any use of row i's right-hand side, though what other rows
  /// take off may be in it already, and last(i, x[i]) as soon as the row is known, though others still read it.
  template <class Rows, class First, class Last>
  void solve(Rows& x, First&& first, Last&& last) const {
    if (symmetric_) {
      for (int k = 0; k < pattern_->n(); ++k) reduce(k, x, first);
      substitute(x, last);
    } else {
      solve_both(x, first, last);
    }
  }
  /// Factorises and solves, on one way through the rows there and one back. False when a pivot block is singular.
  template <class Rows, class First, class Last>
  bool factorize_and_solve(Rows& x, First&& first, Last&& last) {
    if (!symmetric_) {
      if (!factorize_both()) return false;
      solve_both(x, first, last);
      return true;
    }
    for (int k = 0; k < pattern_->n(); ++k) {
      if (!eliminate(k)) return false;
      reduce(k, x, first);
    }
    substitute(x, last);
    return true;
  }

 private:
  PINTLE_LANES static void clear(Block<T, N>& block) {
    for (int r = 0; r < N; ++r)
      for (int c = 0; c < N; ++c) block(r, c) = T(0.0);
  }

  bool factorize_both() {
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

  bool factorize_upper() {
    for (int k = 0; k < pattern_->n(); ++k)
      if (!eliminate(k)) return false;
    return true;
  }

  // Pivot blocks Z are L D L', and what stands above the diagonal becomes Z^-1 U: in a solve each row waits for one product with the
  // row before it and for nothing else.
  PINTLE_LANES bool eliminate(int k) {
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

  // Row k on the way there.
  template <class Rows, class First>
  PINTLE_LANES void reduce(int k, Rows& x, First& first) const {
    const BlockPattern& p = *pattern_;
    const int i = p.row_at(k), end = p.first(k + 1);
    auto& here = x[i];
    first(i, here);
    for (int a = p.first(k); a < end; ++a) subtract_transposed_product(x[p.row_at(p.column(a))], upper_[a], here);
    apply_inverse(diagonal_[k], here);
  }

  // The way back.
  template <class Rows, class Last>
  void substitute(Rows& rows, Last& last) const {
    const BlockPattern& p = *pattern_;
    const Block<T, N>* const upper = upper_.data();  // no store reaches these
    auto* const x = rows.data();
    for (int k = p.n() - 1; k >= 0; --k) {
      const int i = p.row_at(k), end = p.first(k + 1);
      auto& here = x[i];
      for (int a = p.first(k); a < end; ++a) subtract_product(here, upper[a], x[p.row_at(p.column(a))]);
      last(i, std::as_const(here));
    }
  }

  template <class Rows, class First, class Last>
  void solve_both(Rows& x, First& first, Last& last) const {
    const BlockPattern& p = *pattern_;
    for (int k = 0; k < p.n(); ++k) {
      auto& done = x[p.row_at(k)];
      first(p.row_at(k), done);
      for (int a = p.first(k); a < p.first(k + 1); ++a) subtract_product(x[p.row_at(p.column(a))], lower_[a], done);
    }
    for (int k = p.n() - 1; k >= 0; --k) {
      auto& here = x[p.row_at(k)];
      for (int a = p.first(k); a < p.first(k + 1); ++a) subtract_product(here, upper_[a], x[p.row_at(p.column(a))]);
      here = product(diagonal_[k], here);
      last(p.row_at(k), std::as_const(here));
    }
  }

  const BlockPattern* pattern_ = nullptr;
  bool symmetric_ = false;
  std::vector<Block<T, N>> diagonal_, upper_, lower_;
  std::vector<Block<T, N>> row_;  // of the pivot
};

}  // namespace pintle
