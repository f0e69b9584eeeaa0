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

/// Sine and cosine, to 1.2e-16 up to kLargestAngle, beyond it the standard library's. The angle is reduced to an eighth of a
/// turn either side of zero by subtracting quarters in two parts, of which the first has 33 bits (Cody and Waite, Software
/// Manual for the Elementary Functions, chapter 8); there the polynomials of fdlibm's kernel functions.
constexpr double kLargestAngle = 1e5;  // [rad]

inline void sine_and_cosine(DoublePair x, DoublePair& sine, DoublePair& cosine) {
  typedef unsigned long long LongPair __attribute__((vector_size(16)));
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: what is added to it loses its fraction
  constexpr double kQuarter = 1.57079632673412561417e+00, kRest = 6.07710050650619224932e-11;
  if (!(std::abs(x[0]) < kLargestAngle && std::abs(x[1]) < kLargestAngle)) {
    sine = DoublePair{std::sin(x[0]), std::sin(x[1])};
    cosine = DoublePair{std::cos(x[0]), std::cos(x[1])};
    return;
  }
  const DoublePair shifted = x * 6.36619772367581382433e-01 + kRound, quarters = shifted - kRound;
  const LongPair n = (LongPair)shifted;
  const DoublePair r = (x - quarters * kQuarter) - quarters * kRest, z = r * r;
  const DoublePair s = r + r * z * (-1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 +
      z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const DoublePair half = 0.5 * z, one_less = 1 - half;
  const DoublePair c = one_less + ((1 - one_less) - half + z * z * (4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 +
      z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))));
  const LongPair odd = -(n & 1), sign_s = (n & 2) << 62, sign_c = ((n + 1) & 2) << 62;
  const LongPair bits_s = (LongPair)s, bits_c = (LongPair)c;
  const LongPair out_s = ((bits_c & odd) | (bits_s & ~odd)) ^ sign_s, out_c = ((bits_s & odd) | (bits_c & ~odd)) ^ sign_c;
  sine = (DoublePair)out_s;
  cosine = (DoublePair)out_c;
}

template <int N>
inline void sine_and_cosine(const Lanes<N>& angle, Lanes<N>& sine, Lanes<N>& cosine) {
  for (int i = 0; i < Lanes<N>::kPairs; ++i) sine_and_cosine(angle.p[i], sine.p[i], cosine.p[i]);
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
