// The numbers of a system that falls apart into N / 2 complex ones and a real one: all of them in one go through the block
// factorisation. Lanes: (re, im) of each complex number, the real one last.
#pragma once

#include <cmath>
#include <limits>

#include "solve/block.h"
#include "solve/lanes.h"

namespace pintle {

template <int N>
struct Spectrum {
  Lanes<N> x;

  Spectrum() = default;
  explicit Spectrum(const Lanes<N>& lanes) : x(lanes) {}
  explicit Spectrum(double real) {
    for (int i = 0; i + 1 < Lanes<N>::kPairs; ++i) x.p[i] = DoublePair{real, 0};
    x.p[Lanes<N>::kPairs - 1] = DoublePair{real, real};
  }

  Spectrum& operator+=(const Spectrum& b) { x += b.x; return *this; }
  Spectrum& operator-=(const Spectrum& b) { x -= b.x; return *this; }
  friend Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend Spectrum operator-(Spectrum a, const Spectrum& b) { return a -= b; }
  friend Spectrum operator-(const Spectrum& a) { return Spectrum(-a.x); }
  friend Spectrum operator*(double f, const Spectrum& a) { return Spectrum(f * a.x); }
  friend Spectrum operator*(const Spectrum& a, const Spectrum& b) {
    Spectrum r;
    constexpr int last = Lanes<N>::kPairs - 1;
    for (int i = 0; i < last; ++i) {
      const DoublePair u = a.x.p[i], v = b.x.p[i];
      r.x.p[i] = DoublePair{u[0], u[0]} * v + DoublePair{-u[1], u[1]} * swapped(v);
    }
    r.x.p[last] = a.x.p[last] * b.x.p[last];
    return r;
  }
  friend Spectrum reciprocal(const Spectrum& a) {
    Spectrum r;
    constexpr int last = Lanes<N>::kPairs - 1;
    for (int i = 0; i < last; ++i) {
      const DoublePair u = a.x.p[i];
      const double d = 1 / (u[0] * u[0] + u[1] * u[1]);
      r.x.p[i] = DoublePair{u[0] * d, -u[1] * d};
    }
    r.x.p[last] = 1 / a.x.p[last];
    return r;
  }
};

/// The least of its numbers, NaN when one is not finite.
template <int N>
inline double magnitude(const Spectrum<N>& a) {
  constexpr int last = Lanes<N>::kPairs - 1;
  double least = std::abs(a.x.p[last][0]), sum = least;
  for (int i = 0; i < last; ++i) {
    const double size = std::abs(a.x.p[i][0]) + std::abs(a.x.p[i][1]);
    least = size < least ? size : least;
    sum += size;
  }
  return std::isfinite(sum) ? least : std::numeric_limits<double>::quiet_NaN();
}

/// Each number would want a pivot of its own. None is needed: mass, damping and stiffness keep every one of them, turned by a
/// common angle, in the right half plane, and so does elimination in any order. theory/time section 3.3.
template <int N>
inline constexpr bool kPivots<Spectrum<N>> = false;

}  // namespace pintle
