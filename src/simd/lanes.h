// N numbers that go through the same arithmetic in one machine register: one per stage of an implicit step, one per part of its
// diagonal frame, or one per variant of a mechanism. Narrower registers are used several times; the bits of the results are the
// same.
#pragma once

#include <cmath>

#include "simd/registers.h"

namespace pintle {

/// Lanes beyond N follow lane N - 1, so that they never overflow on their own.
template <int N>
struct Lanes {
  using Register = typename Registers<N>::Reals;
  static constexpr int kWidth = sizeof(Register) / sizeof(double);
  alignas(sizeof(Register)) Register v;  // as wide registers require, even where they are not used

  Lanes() = default;
  PINTLE_LANES Lanes(const Register& x) : v(x) {}
  PINTLE_LANES explicit Lanes(double x) : v(x - Register{}) {}

  PINTLE_LANES static Lanes all(double x) { return Lanes(x); }
  PINTLE_LANES static Lanes of(const double (&x)[N]) {
    Lanes r = all(x[N - 1]);
    for (int i = 0; i < N - 1; ++i) set_lane(r.v, i, x[i]);
    return r;
  }
  PINTLE_LANES double operator[](int i) const { return v[i]; }
  PINTLE_LANES void set(int i, double x) {
    set_lane(v, i, x);
    if (i == N - 1)
      for (int k = N; k < kWidth; ++k) set_lane(v, k, x);
  }

  PINTLE_LANES Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }
  PINTLE_LANES Lanes& operator-=(const Lanes& b) {
    v -= b.v;
    return *this;
  }
  PINTLE_LANES Lanes& operator*=(const Lanes& b) {
    v *= b.v;
    return *this;
  }
  PINTLE_LANES friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.v + b.v}; }
  PINTLE_LANES friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.v - b.v}; }
  PINTLE_LANES friend Lanes operator*(const Lanes& a, const Lanes& b) { return {a.v * b.v}; }
  PINTLE_LANES friend Lanes operator-(const Lanes& a) { return {-a.v}; }
  PINTLE_LANES friend Lanes operator*(double x, const Lanes& a) { return {x * a.v}; }
  PINTLE_LANES friend Lanes operator*(const Lanes& a, double x) { return {x * a.v}; }
};

/// Subtracts x from one lane.
template <int N>
PINTLE_LANES void subtract(Lanes<N>& from, int lane, double x) {
  from.set(lane, from[lane] - x);
}

template <int N>
PINTLE_LANES Lanes<N> reciprocal(const Lanes<N>& a) {
  return {1 / a.v};
}

template <int N>
PINTLE_LANES Lanes<N> larger(const Lanes<N>& a, const Lanes<N>& b) {
  return {where_less(a.v, b.v, b.v, a.v)};
}
template <int N>
PINTLE_LANES Lanes<N> smaller(const Lanes<N>& a, const Lanes<N>& b) {
  return {where_less(b.v, a.v, b.v, a.v)};
}
/// x where a is larger than b; elsewhere y.
template <int N>
PINTLE_LANES Lanes<N> where_larger(const Lanes<N>& a, const Lanes<N>& b, const Lanes<N>& x, const Lanes<N>& y) {
  return {where_less(b.v, a.v, x.v, y.v)};
}
template <int N>
PINTLE_LANES Lanes<N> sizes(const Lanes<N>& a) {
  return {where_less(a.v, -a.v, -a.v, a.v)};
}

/// Rows become columns.
PINTLE_LANES void transpose(Lanes<4> (&rows)[4]) {
  const auto even_low = __builtin_shufflevector(rows[0].v, rows[1].v, 0, 4, 2, 6), odd_low = __builtin_shufflevector(rows[0].v, rows[1].v, 1, 5, 3, 7);
  const auto even_high = __builtin_shufflevector(rows[2].v, rows[3].v, 0, 4, 2, 6), odd_high = __builtin_shufflevector(rows[2].v, rows[3].v, 1, 5, 3, 7);
  rows[0].v = __builtin_shufflevector(even_low, even_high, 0, 1, 4, 5);
  rows[1].v = __builtin_shufflevector(odd_low, odd_high, 0, 1, 4, 5);
  rows[2].v = __builtin_shufflevector(even_low, even_high, 2, 3, 6, 7);
  rows[3].v = __builtin_shufflevector(odd_low, odd_high, 2, 3, 6, 7);
}

/// The larger of a and the magnitude of b, lane by lane.
template <int N>
PINTLE_LANES Lanes<N> larger_size(const Lanes<N>& a, const Lanes<N>& b) {
  return larger(a, sizes(b));
}

/// Sine and cosine, to 1.2e-16, of angles up to kLargestAngle. The angle is reduced to an eighth of a turn either side of zero by
/// subtracting quarter turns in two parts, the first of which has 33 bits (Cody and Waite, Software Manual for the Elementary
/// Functions, chapter 8); the polynomials there are those of fdlibm's kernel functions.
constexpr double kLargestAngle = 1e5;  // [rad]

template <int N>
PINTLE_LANES void sine_and_cosine_unchecked(const Lanes<N>& angle, Lanes<N>& sine, Lanes<N>& cosine) {
  using Register = typename Lanes<N>::Register;
  using Bits = typename Registers<N>::Bits;
  const Register x = angle.v;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: a number added to it loses its fraction
  constexpr double kQuarter = 1.57079632673412561417e+00, kRest = 6.07710050650619224932e-11;
  const Register shifted = x * 6.36619772367581382433e-01 + kRound, quarters = shifted - kRound;
  const Bits n = bits_of(shifted);
  const Register r = (x - quarters * kQuarter) - quarters * kRest, z = r * r;
  const Register s = r + r * z * (-1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 +
      z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const Register half = 0.5 * z, one_less = 1 - half;
  const Register c = one_less + ((1 - one_less) - half + z * z * (4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05 +
      z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))))));
  const Bits odd = -(n & 1), sign_s = (n & 2) << 62, sign_c = ((n + 1) & 2) << 62;
  const Bits bits_s = bits_of(s), bits_c = bits_of(c);
  const Bits out_s = ((bits_c & odd) | (bits_s & ~odd)) ^ sign_s, out_c = ((bits_s & odd) | (bits_c & ~odd)) ^ sign_c;
  sine.v = reals_of(out_s);
  cosine.v = reals_of(out_c);
}

/// Whether a lane is beyond kLargestAngle.
template <int N>
PINTLE_LANES bool any_beyond_largest_angle(const Lanes<N>& sizes) {
  bool any = false;
  for (int i = 0; i < N; ++i) any = any || sizes[i] >= kLargestAngle;
  return any;
}

/// The same for any angle: the standard library's functions are used for large ones.
template <int N>
PINTLE_LANES void sine_and_cosine(const Lanes<N>& angle, Lanes<N>& sine, Lanes<N>& cosine) {
  if (!any_beyond_largest_angle(sizes(angle))) {
    sine_and_cosine_unchecked(angle, sine, cosine);
    return;
  }
  for (int i = 0; i < N; ++i) {
    sine.set(i, std::sin(angle[i]));
    cosine.set(i, std::cos(angle[i]));
  }
}

/// A matrix stored by columns.
template <int N>
struct LaneMatrix {
  Lanes<N> column[N];

  PINTLE_LANES Lanes<N> operator*(const Lanes<N>& x) const {
    Lanes<N> y = x[0] * column[0];
    for (int i = 1; i < N; ++i) y += x[i] * column[i];
    return y;
  }
};

}  // namespace pintle
