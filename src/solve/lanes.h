// N numbers that go through the same arithmetic, two to a machine register: one per stage of an implicit step, or one per
// part of its diagonal frame.
#pragma once

#include <cmath>

namespace pintle {

/// Two numbers in a register of 128 bits.
typedef double DoublePair __attribute__((vector_size(16)));

inline DoublePair swapped(DoublePair a) { return DoublePair{a[1], a[0]}; }

/// Odd N leaves the last half register unused; it follows lane N - 1, so that it never overflows on its own.
template <int N>
struct Lanes {
  static_assert(N % 2 == 1);
  static constexpr int kPairs = (N + 1) / 2;
  DoublePair p[kPairs];

  static Lanes all(double x) {
    Lanes r;
    for (auto& pair : r.p) pair = DoublePair{x, x};
    return r;
  }
  double operator[](int i) const { return p[i / 2][i % 2]; }
  void set(int i, double x) {
    p[i / 2][i % 2] = x;
    if (i == N - 1) p[i / 2][1] = x;
  }

  Lanes& operator+=(const Lanes& b) {
    for (int i = 0; i < kPairs; ++i) p[i] += b.p[i];
    return *this;
  }
  Lanes& operator-=(const Lanes& b) {
    for (int i = 0; i < kPairs; ++i) p[i] -= b.p[i];
    return *this;
  }
  Lanes& operator*=(const Lanes& b) {
    for (int i = 0; i < kPairs; ++i) p[i] *= b.p[i];
    return *this;
  }
  friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
  friend Lanes operator-(Lanes a, const Lanes& b) { return a -= b; }
  friend Lanes operator*(Lanes a, const Lanes& b) { return a *= b; }
  friend Lanes operator-(Lanes a) {
    for (auto& pair : a.p) pair = -pair;
    return a;
  }
  friend Lanes operator*(double x, Lanes a) {
    for (auto& pair : a.p) pair *= DoublePair{x, x};
    return a;
  }
  friend Lanes operator*(const Lanes& a, double x) { return x * a; }
};

/// The larger of the sizes, lane by lane.
template <int N>
inline Lanes<N> larger_size(Lanes<N> a, const Lanes<N>& b) {
  for (int i = 0; i < Lanes<N>::kPairs; ++i) {
    const DoublePair size = b.p[i] < -b.p[i] ? -b.p[i] : b.p[i];
    a.p[i] = size > a.p[i] ? size : a.p[i];
  }
  return a;
}

template <int N>
inline void sine_and_cosine(const Lanes<N>& angle, Lanes<N>& sine, Lanes<N>& cosine) {
  for (int i = 0; i < N; ++i) {
    sine.set(i, std::sin(angle[i]));
    cosine.set(i, std::cos(angle[i]));
  }
}

/// A matrix by its columns.
template <int N>
struct LaneMatrix {
  Lanes<N> column[N];

  Lanes<N> operator*(const Lanes<N>& x) const {
    Lanes<N> y = x[0] * column[0];
    for (int i = 1; i < N; ++i) y += x[i] * column[i];
    return y;
  }
};

}  // namespace pintle
