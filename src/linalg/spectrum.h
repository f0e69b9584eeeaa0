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
  Lanes<N> x;

  Spectrum() = default;
  PINTLE_LANES explicit Spectrum(const Lanes<N>& lanes) : x(lanes) {}
  PINTLE_LANES explicit Spectrum(double real) {
    double parts[N];
    for (int i = 0; i < N; ++i) parts[i] = i + 1 < N && i % 2 == 1 ? 0 : real;
    x = Lanes<N>::of(parts);
  }

  PINTLE_LANES Spectrum& operator+=(const Spectrum& b) { x += b.x; return *this; }
  PINTLE_LANES Spectrum& operator-=(const Spectrum& b) { x -= b.x; return *this; }
  PINTLE_LANES friend Spectrum operator+(const Spectrum& a, const Spectrum& b) { return Spectrum(a.x + b.x); }
  PINTLE_LANES friend Spectrum operator-(const Spectrum& a, const Spectrum& b) { return Spectrum(a.x - b.x); }
  PINTLE_LANES friend Spectrum operator-(const Spectrum& a) { return Spectrum(-a.x); }
  PINTLE_LANES friend Spectrum operator*(double f, const Spectrum& a) { return Spectrum(f * a.x); }
  // (re re) (re im) + (im im) (-im re); without an imaginary part the second term is zero.
  PINTLE_LANES friend Spectrum operator*(const Spectrum& a, const Spectrum& b) {
    return Spectrum(Lanes<N>{product(a.x.v, b.x.v)});
  }
  PINTLE_LANES friend Spectrum reciprocal(const Spectrum& a) {
    return Spectrum(Lanes<N>{inverse(a.x.v)});
  }

 private:
  // One register: complex numbers in the lanes before kReal, a real number in those from there on.
  template <class R, int kReal>
  struct Mixed {
    static constexpr int kLanes = sizeof(R) / sizeof(double);  // of the register
    PINTLE_LANES static R product(const R& a, const R& b) {
      if constexpr (kReal == 0) return a * b;
      else return real_parts(a) * b + imaginary_parts(a) * (signs(-1, 1, 0) * swapped(b));
    }
    PINTLE_LANES static R inverse(const R& a) {
      const R square = a * a;
      if constexpr (kReal == 0) return a / square;
      else return (signs(1, -1, 1) * a) / (square + signs(1, 1, 0) * swapped(square));
    }
    // The entry at place `from(i)` moves to place i.
    template <class From, std::size_t... I>
    PINTLE_LANES static R rearranged(const R& a, From, std::index_sequence<I...>) {
      return __builtin_shufflevector(a, a, From{}(static_cast<int>(I))...);
    }
    template <class From>
    PINTLE_LANES static R rearranged(const R& a, From from) {
      return rearranged(a, from, std::make_index_sequence<kLanes>());
    }
    PINTLE_LANES static R real_parts(const R& a) {
      return rearranged(a, [](int i) constexpr { return i < kReal ? i & ~1 : i; });
    }
    PINTLE_LANES static R imaginary_parts(const R& a) {
      return rearranged(a, [](int i) constexpr { return i < kReal ? i | 1 : i; });
    }
    PINTLE_LANES static R swapped(const R& a) {
      return rearranged(a, [](int i) constexpr { return i < kReal ? i ^ 1 : i; });
    }
    PINTLE_LANES static R signs(double re, double im, double real) {
      R s;
      for (int i = 0; i < kLanes; ++i) s[i] = i >= kReal ? real : i % 2 == 0 ? re : im;
      return s;
    }
  };
  template <class R>
  PINTLE_LANES static R product(const R& a, const R& b) {
    return Mixed<R, N - 1>::product(a, b);
  }
  PINTLE_LANES static EightReals product(const EightReals& a, const EightReals& b) {
    return {Mixed<FourReals, 4>::product(a.low, b.low), Mixed<FourReals, N - 5>::product(a.high, b.high)};
  }
  template <class R>
  PINTLE_LANES static R inverse(const R& a) {
    return Mixed<R, N - 1>::inverse(a);
  }
  PINTLE_LANES static EightReals inverse(const EightReals& a) {
    return {Mixed<FourReals, 4>::inverse(a.low), Mixed<FourReals, N - 5>::inverse(a.high)};
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
