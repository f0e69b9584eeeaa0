// The numbers of a system that decouples into N / 2 complex systems and a real one: all of them pass through the block
// factorisation together. Lanes: (re, im) of each complex number, the real one last.
#pragma once

#include <cstddef>
#include <utility>

#include "linalg/block.h"
#include "simd/lanes.h"

namespace pintle {

template <int N>
struct Spectrum {
  using Register = typename Lanes<N>::Register;
  static constexpr int kWidth = Lanes<N>::kWidth;
  Lanes<N> x;

  Spectrum() = default;
  PINTLE_LANES explicit Spectrum(const Lanes<N>& lanes) : x(lanes) {}
  PINTLE_LANES explicit Spectrum(double real) {
    for (int i = 0; i < kWidth; ++i) x.v[i] = i + 1 < N && i % 2 == 1 ? 0 : real;
  }

  PINTLE_LANES Spectrum& operator+=(const Spectrum& b) { x += b.x; return *this; }
  PINTLE_LANES Spectrum& operator-=(const Spectrum& b) { x -= b.x; return *this; }
  PINTLE_LANES friend Spectrum operator+(const Spectrum& a, const Spectrum& b) { return Spectrum(a.x + b.x); }
  PINTLE_LANES friend Spectrum operator-(const Spectrum& a, const Spectrum& b) { return Spectrum(a.x - b.x); }
  PINTLE_LANES friend Spectrum operator-(const Spectrum& a) { return Spectrum(-a.x); }
  PINTLE_LANES friend Spectrum operator*(double f, const Spectrum& a) { return Spectrum(f * a.x); }
  // (re re) (re im) + (im im) (-im re); without an imaginary part the second term is zero.
  PINTLE_LANES friend Spectrum operator*(const Spectrum& a, const Spectrum& b) {
    return Spectrum(Lanes<N>{real_parts(a.x.v) * b.x.v + imaginary_parts(a.x.v) * turned(b.x.v)});
  }
  PINTLE_LANES friend Spectrum reciprocal(const Spectrum& a) {
    const Register u = a.x.v, square = u * u;
    return Spectrum(Lanes<N>{conjugate(u) / (square + imaginary(swapped(square)))});
  }

 private:
  // The lanes of the complex numbers come first, in pairs. The entry at place `from(i)` moves to place i.
  template <class From, std::size_t... I>
  PINTLE_LANES static Register rearranged(const Register& a, From, std::index_sequence<I...>) {
    return __builtin_shufflevector(a, a, From{}(I)...);
  }
  template <class From>
  PINTLE_LANES static Register rearranged(const Register& a, From from) {
    return rearranged(a, from, std::make_index_sequence<kWidth>());
  }
  PINTLE_LANES static Register real_parts(const Register& a) {
    return rearranged(a, [](std::size_t i) constexpr { return i + 1 < N ? i & ~1ul : i; });
  }
  PINTLE_LANES static Register imaginary_parts(const Register& a) {
    return rearranged(a, [](std::size_t i) constexpr { return i + 1 < N ? i | 1 : i; });
  }
  // Times the imaginary unit; zero for the real number.
  PINTLE_LANES static Register turned(const Register& a) { return signs(-1, 1, 0) * swapped(a); }
  PINTLE_LANES static Register swapped(const Register& a) {
    return rearranged(a, [](std::size_t i) constexpr { return i + 1 < N ? i ^ 1 : i; });
  }
  PINTLE_LANES static Register conjugate(const Register& a) { return signs(1, -1, 1) * a; }
  PINTLE_LANES static Register imaginary(const Register& a) { return signs(1, 1, 0) * a; }
  PINTLE_LANES static Register signs(double re, double im, double real) {
    if constexpr (N == 1) return Register{real, real};
    else if constexpr (N == 3) return Register{re, im, real, real};
    else return Register{re, im, re, im, real, real, real, real};
  }
};

/// The real number alone times four numbers, for solving the real system with several right-hand sides.
template <int N>
PINTLE_LANES Lanes<4> operator*(const Spectrum<N>& a, const Lanes<4>& b) {
  return a.x[N - 1] * b;
}

template <int N>
PINTLE_LANES bool is_finite(const Spectrum<N>& a) {
  double nothing = 0;
  for (int i = 0; i < N; ++i) nothing += 0 * a.x[i];
  return nothing == 0;
}

/// Each number would need its own pivots, but pivoting is not needed: with mass, damping and stiffness every pivot is, turned
/// by a common angle, in the right half plane, and elimination in any order keeps it there. theory/time section 3.3.
template <int N>
inline constexpr bool kPivots<Spectrum<N>> = false;

}  // namespace pintle
