// Small dense blocks, real or complex, with loops the compiler can unroll.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "simd/lanes.h"

namespace pintle {

inline double reciprocal(double a) { return 1 / a; }

inline double magnitude(double a) { return std::abs(a); }

inline bool is_finite(double a) { return std::isfinite(a); }

/// Whether blocks of T are inverted with row pivoting.
template <class T>
inline constexpr bool kPivots = true;

/// Real symmetric matrices of variants in lanes are positive definite; a NaN in one lane concerns only that lane.
template <int N>
inline constexpr bool kPivots<Lanes<N>> = false;
template <int N>
PINTLE_LANES bool is_finite(const Lanes<N>&) {
  return true;
}

template <class T, int N>
struct BlockVec {
  std::array<T, N> a{};
  T& operator[](int i) { return a[i]; }
  const T& operator[](int i) const { return a[i]; }
};

/// An N x N matrix, row-major.
template <class T, int N>
struct Block {
  std::array<T, N * N> a{};
  T& operator()(int i, int j) { return a[i * N + j]; }
  const T& operator()(int i, int j) const { return a[i * N + j]; }
};

/// Three numbers in a register. The fourth is unused.
template <>
struct BlockVec<double, 3> {
  alignas(32) std::array<double, 4> a{};
  double& operator[](int i) { return a[i]; }
  const double& operator[](int i) const { return a[i]; }

  PINTLE_LANES Lanes<4> lanes() const {
    Lanes<4> x;
    std::memcpy(&x.v, a.data(), sizeof x.v);
    return x;
  }
  PINTLE_LANES void set(const Lanes<4>& x) { std::memcpy(a.data(), &x.v, sizeof x.v); }
};

/// 3 x 3 with each row in a register.
template <>
struct Block<double, 3> {
  std::array<BlockVec<double, 3>, 3> rows{};
  double& operator()(int i, int j) { return rows[i][j]; }
  const double& operator()(int i, int j) const { return rows[i][j]; }
};

/// C -= A B.
template <class T, int N>
PINTLE_LANES void subtract_product(Block<T, N>& C, const Block<T, N>& A, const Block<T, N>& B) {
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < N; ++k) {
      const T aik = A(i, k);
      for (int j = 0; j < N; ++j) C(i, j) -= aik * B(k, j);
    }
}

/// C -= A' B.
template <class T, int N>
PINTLE_LANES void subtract_transposed_product(Block<T, N>& C, const Block<T, N>& A, const Block<T, N>& B) {
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < N; ++k) {
      const T aki = A(k, i);
      for (int j = 0; j < N; ++j) C(i, j) -= aki * B(k, j);
    }
}

/// C -= A' B, where A' B and C are symmetric: the upper triangle of C is not changed.
template <class T, int N>
PINTLE_LANES void subtract_symmetric_product(Block<T, N>& C, const Block<T, N>& A, const Block<T, N>& B) {
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      if (j < i) continue;
      T sum = C(j, i);
      for (int k = 0; k < N; ++k) sum -= A(k, i) * B(k, j);
      C(j, i) = sum;
    }
}

/// y -= A x, for vectors of N numbers of any type.
template <class V, class T, int N>
PINTLE_LANES void subtract_product(V& y, const Block<T, N>& A, const V& x) {
  V sum = y;  // which may alias x, as far as the compiler knows
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) sum[i] -= A(i, j) * x[j];
  y = sum;
}

/// y -= A' x.
template <class V, class T, int N>
PINTLE_LANES void subtract_transposed_product(V& y, const Block<T, N>& A, const V& x) {
  V sum = y;
  for (int j = 0; j < N; ++j)
    for (int i = 0; i < N; ++i) sum[i] -= A(j, i) * x[j];
  y = sum;
}

/// The row swaps of a pivoted factorisation, in order: row c with row swaps[c].
template <int N>
struct RowSwaps {
  std::array<int, N> with{};
  int& operator[](int c) { return with[c]; }
  int operator[](int c) const { return with[c]; }
};

template <bool kAny, int N, class Swap>
PINTLE_LANES void swap_rows(const RowSwaps<N>& swaps, Swap&& swap) {
  if constexpr (kAny)
    for (int c = 0; c < N; ++c)
      if (swaps[c] != c) swap(c, swaps[c]);
}

/// Strictly below the diagonal: a unit lower triangle becomes its inverse.
template <class T, int N>
PINTLE_LANES void invert_unit_lower_triangle(Block<T, N>& m) {
  for (int i = 1; i < N; ++i)
    for (int j = 0; j < i; ++j) {
      T sum = m(i, j);
      for (int k = j + 1; k < i; ++k) sum += m(i, k) * m(k, j);
      m(i, j) = -sum;
    }
}

/// P A = L D U in place: the strict triangles become those of L^-1 and U^-1, the diagonal D^-1. Solving with the factors, unlike multiplying by an explicit
/// inverse, keeps a nearly singular block from contaminating the rest of the matrix. False when a pivot is zero or not finite.
template <class T, int N>
PINTLE_LANES bool factorize_pivoted(Block<T, N>& m, RowSwaps<N>& swaps) {
  T pivots = T(0.0);
  for (int c = 0; c < N; ++c) {
    swaps[c] = c;
    if constexpr (kPivots<T>) {
      for (int r = c + 1; r < N; ++r)
        if (magnitude(m(r, c)) > magnitude(m(swaps[c], c))) swaps[c] = r;
      if (swaps[c] != c)
        for (int j = 0; j < N; ++j) std::swap(m(swaps[c], j), m(c, j));
    }
    const T inverse = reciprocal(m(c, c));
    pivots += inverse + 0.0 * m(c, c);
    for (int i = c + 1; i < N; ++i) {
      m(i, c) = m(i, c) * inverse;
      for (int j = c + 1; j < N; ++j) m(i, j) -= m(i, c) * m(c, j);
    }
    for (int j = c + 1; j < N; ++j) m(c, j) = inverse * m(c, j);
    m(c, c) = inverse;
  }
  invert_unit_lower_triangle(m);
  for (int j = N - 1; j > 0; --j)
    for (int i = j - 1; i >= 0; --i) {
      T sum = m(i, j);
      for (int k = i + 1; k < j; ++k) sum += m(i, k) * m(k, j);
      m(i, j) = -sum;
    }
  return is_finite(pivots);
}

/// Factorises the symmetric m = L D L' without pivoting, reading its lower triangle. In place: D^-1 on the diagonal and below it M = L^-1, whose diagonal is 1. False if a
/// pivot is zero or not finite.
template <class T, int N>
PINTLE_LANES bool factorize_symmetric(Block<T, N>& m) {
  T lower[N], pivots = T(0.0);
  for (int c = 0; c < N; ++c) {
    const T inverse = reciprocal(m(c, c));
    pivots += inverse + 0.0 * m(c, c);
    for (int i = c + 1; i < N; ++i) {
      lower[i] = m(i, c) * inverse;
      for (int j = c + 1; j <= i; ++j) m(i, j) -= lower[i] * m(j, c);
    }
    for (int i = c + 1; i < N; ++i) m(i, c) = lower[i];
    m(c, c) = inverse;
  }
  invert_unit_lower_triangle(m);
  return is_finite(pivots);
}

/// B becomes M B, with M from a factorised m.
template <class T, int N>
PINTLE_LANES void apply_lower(const Block<T, N>& m, Block<T, N>& B) {
  for (int i = N - 1; i > 0; --i)
    for (int j = 0; j < i; ++j)
      for (int c = 0; c < N; ++c) B(i, c) += m(i, j) * B(j, c);
}

/// x becomes M x.
template <class V, class T, int N>
PINTLE_LANES void apply_lower(const Block<T, N>& m, V& x) {
  for (int i = N - 1; i > 0; --i)
    for (int j = 0; j < i; ++j) x[i] += m(i, j) * x[j];
}

/// B becomes B U^-1 D^-1, of a block factorised with pivoting.
template <class T, int N>
PINTLE_LANES void solve_upper_from_right(const Block<T, N>& m, Block<T, N>& B) {
  for (int j = N - 1; j >= 0; --j)
    for (int r = 0; r < N; ++r) {
      T sum = B(r, j);
      for (int i = 0; i < j; ++i) sum += B(r, i) * m(i, j);
      B(r, j) = sum * m(j, j);
    }
}

/// x becomes L^-1 P x.
template <class V, class T, int N>
PINTLE_LANES void solve_lower(const Block<T, N>& m, const RowSwaps<N>& swaps, V& x) {
  swap_rows<kPivots<T>>(swaps, [&x](int a, int b) { std::swap(x[a], x[b]); });
  apply_lower(m, x);
}

/// B becomes L^-1 P B.
template <class T, int N>
PINTLE_LANES void solve_lower(const Block<T, N>& m, const RowSwaps<N>& swaps, Block<T, N>& B) {
  swap_rows<kPivots<T>>(swaps, [&B](int a, int b) {
    for (int c = 0; c < N; ++c) std::swap(B(a, c), B(b, c));
  });
  apply_lower(m, B);
}

/// x becomes U^-1 D^-1 x.
template <class V, class T, int N>
PINTLE_LANES void solve_upper(const Block<T, N>& m, V& x) {
  for (int i = 0; i < N; ++i) x[i] = m(i, i) * x[i];
  for (int i = 0; i < N - 1; ++i)
    for (int j = i + 1; j < N; ++j) x[i] += m(i, j) * x[j];
}

/// B becomes M' B.
template <class T, int N>
PINTLE_LANES void apply_lower_transposed(const Block<T, N>& m, Block<T, N>& B) {
  for (int j = 0; j < N - 1; ++j)
    for (int i = j + 1; i < N; ++i)
      for (int c = 0; c < N; ++c) B(j, c) += m(i, j) * B(i, c);
}

/// D^-1 B.
template <class T, int N>
PINTLE_LANES Block<T, N> over_pivots(const Block<T, N>& m, const Block<T, N>& B) {
  Block<T, N> out;
  for (int i = 0; i < N; ++i)
    for (int c = 0; c < N; ++c) out(i, c) = m(i, i) * B(i, c);
  return out;
}

/// x becomes M' D^-1 M x: solves with a factorised m.
template <class V, class T, int N>
PINTLE_LANES void apply_inverse(const Block<T, N>& m, V& x) {
  apply_lower(m, x);
  for (int i = 0; i < N; ++i) x[i] = m(i, i) * x[i];
  for (int j = 0; j < N - 1; ++j)
    for (int i = j + 1; i < N; ++i) x[j] += m(i, j) * x[i];
}

// The same for real blocks, row by row.
using RealBlock = Block<double, 3>;
using RealRow = BlockVec<double, 3>;

/// C -= A' B.
PINTLE_LANES void subtract_transposed_product(RealBlock& C, const RealBlock& A, const RealBlock& B) {
  for (int i = 0; i < 3; ++i) {
    Lanes<4> sum = C.rows[i].lanes();
    for (int k = 0; k < 3; ++k) sum -= A(k, i) * B.rows[k].lanes();
    C.rows[i].set(sum);
  }
}

/// C -= A' B, where A' B and C are symmetric.
PINTLE_LANES void subtract_symmetric_product(RealBlock& C, const RealBlock& A, const RealBlock& B) { subtract_transposed_product(C, A, B); }

/// y -= A x.
PINTLE_LANES void subtract_product(RealRow& y, const RealBlock& A, const RealRow& x) {
  Lanes<4> columns[4] = {A.rows[0].lanes(), A.rows[1].lanes(), A.rows[2].lanes(), Lanes<4>::all(0)}, sum = y.lanes();
  transpose(columns);
  for (int j = 0; j < 3; ++j) sum -= x[j] * columns[j];
  y.set(sum);
}

/// y -= A' x.
PINTLE_LANES void subtract_transposed_product(RealRow& y, const RealBlock& A, const RealRow& x) {
  Lanes<4> sum = y.lanes();
  for (int j = 0; j < 3; ++j) sum -= x[j] * A.rows[j].lanes();
  y.set(sum);
}

/// B becomes M B, with M from a factorised m.
PINTLE_LANES void apply_lower(const RealBlock& m, RealBlock& B) {
  const Lanes<4> first = B.rows[0].lanes(), second = B.rows[1].lanes();
  B.rows[2].set(B.rows[2].lanes() + m(2, 0) * first + m(2, 1) * second);
  B.rows[1].set(second + m(1, 0) * first);
}

/// B becomes M' B.
PINTLE_LANES void apply_lower_transposed(const RealBlock& m, RealBlock& B) {
  const Lanes<4> second = B.rows[1].lanes(), third = B.rows[2].lanes();
  B.rows[0].set(B.rows[0].lanes() + m(1, 0) * second + m(2, 0) * third);
  B.rows[1].set(second + m(2, 1) * third);
}

/// D^-1 B.
PINTLE_LANES RealBlock over_pivots(const RealBlock& m, const RealBlock& B) {
  RealBlock out;
  for (int i = 0; i < 3; ++i) out.rows[i].set(m(i, i) * B.rows[i].lanes());
  return out;
}

}  // namespace pintle
