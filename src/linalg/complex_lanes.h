// A complex number in every lane.
#pragma once

#include "linalg/block.h"
#include "simd/lanes.h"

namespace pintle {

template <int N>
struct ComplexLanes {
  Lanes<N> re, im;

  ComplexLanes() = default;
  PINTLE_LANES explicit ComplexLanes(double real) : re(real), im(0.0) {}
  PINTLE_LANES ComplexLanes(const Lanes<N>& real, const Lanes<N>& imaginary) : re(real), im(imaginary) {}

  PINTLE_LANES ComplexLanes& operator+=(const ComplexLanes& b) {
    re += b.re;
    im += b.im;
    return *this;
  }
  PINTLE_LANES ComplexLanes& operator-=(const ComplexLanes& b) {
    re -= b.re;
    im -= b.im;
    return *this;
  }
  PINTLE_LANES friend ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b) { return {a.re + b.re, a.im + b.im}; }
  PINTLE_LANES friend ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b) { return {a.re - b.re, a.im - b.im}; }
  PINTLE_LANES friend ComplexLanes operator-(const ComplexLanes& a) { return {-a.re, -a.im}; }
  PINTLE_LANES friend ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  PINTLE_LANES friend ComplexLanes operator*(double f, const ComplexLanes& a) { return {f * a.re, f * a.im}; }
  PINTLE_LANES friend ComplexLanes operator*(const Lanes<N>& f, const ComplexLanes& a) { return {f * a.re, f * a.im}; }
  PINTLE_LANES friend ComplexLanes reciprocal(const ComplexLanes& a) {
    const Lanes<N> over = reciprocal(a.re * a.re + a.im * a.im);
    return {a.re * over, -(a.im * over)};
  }
};

/// Each lane is checked separately: a NaN in one is looked for in the results.
template <int N>
PINTLE_LANES bool is_finite(const ComplexLanes<N>&) {
  return true;
}

template <int N>
inline constexpr bool kPivots<ComplexLanes<N>> = false;  // as for Spectrum

}  // namespace pintle
