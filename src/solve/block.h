// Small dense blocks, real or complex, with loops the compiler can unroll.
#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace pintle {

inline double reciprocal(double a) { return 1 / a; }

inline double magnitude(double a) { return std::abs(a); }

/// Whether blocks of T are inverted with row pivoting.
template <class T>
inline constexpr bool kPivots = true;

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

/// C -= A B.
template <class T, int N>
inline void subtract_product(Block<T, N>& C, const Block<T, N>& A, const Block<T, N>& B) {
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < N; ++k) {
      const T aik = A(i, k);
      for (int j = 0; j < N; ++j) C(i, j) -= aik * B(k, j);
    }
}

/// A B.
template <class T, int N>
inline Block<T, N> product(const Block<T, N>& A, const Block<T, N>& B) {
  Block<T, N> C;
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < N; ++k) {
      const T aik = A(i, k);
      for (int j = 0; j < N; ++j) C(i, j) += aik * B(k, j);
    }
  return C;
}

/// y -= A x.
template <class T, class U, int N>
inline void subtract_product(BlockVec<U, N>& y, const Block<T, N>& A, const BlockVec<U, N>& x) {
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) y[i] -= A(i, j) * x[j];
}

/// A x.
template <class T, class U, int N>
inline BlockVec<U, N> product(const Block<T, N>& A, const BlockVec<U, N>& x) {
  BlockVec<U, N> y;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) y[i] += A(i, j) * x[j];
  return y;
}

/// The inverse by Gauss-Jordan elimination; false when a pivot is exactly zero or not finite.
template <class T, int N>
inline bool invert(Block<T, N>& m) {
  Block<T, N> inverse;
  for (int i = 0; i < N; ++i) inverse(i, i) = T(1);
  for (int c = 0; c < N; ++c) {
    int pivot = c;
    if constexpr (kPivots<T>)
      for (int r = c + 1; r < N; ++r)
        if (magnitude(m(r, c)) > magnitude(m(pivot, c))) pivot = r;
    const double size = magnitude(m(pivot, c));
    if (!(size > 0) || !std::isfinite(size)) return false;
    if (pivot != c)
      for (int j = 0; j < N; ++j) {
        std::swap(m(pivot, j), m(c, j));
        std::swap(inverse(pivot, j), inverse(c, j));
      }
    const T scale = reciprocal(m(c, c));
    for (int j = 0; j < N; ++j) {
      m(c, j) = scale * m(c, j);
      inverse(c, j) = scale * inverse(c, j);
    }
    for (int r = 0; r < N; ++r) {
      if (r == c) continue;
      const T f = m(r, c);
      for (int j = 0; j < N; ++j) {
        m(r, j) -= f * m(c, j);
        inverse(r, j) -= f * inverse(c, j);
      }
    }
  }
  m = inverse;
  return true;
}

}  // namespace pintle
