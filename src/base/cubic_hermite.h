// The cubic through the values and derivatives at both ends of a step. theory/time section 5, theory/solvers section 4.
#pragma once

namespace pintle {

/// The cubic from 0 at s = 0 to 1 at s = 1 with zero slope at both ends. N: a number or lanes of numbers.
template <class N>
N cubic_blend(const N& s) {
  return s * s * (3 - 2 * s);
}
/// Value at the fraction s of a step of length h; x and its derivative d at the beginning and at the end. X: a number or a vector.
template <class X>
X cubic_hermite(double s, double h, const X& x0, const X& d0, const X& x1, const X& d1) {
  const double r = 1 - s;
  return x0 + cubic_blend(s) * (x1 - x0) + h * s * r * (r * d0 - s * d1);
}
/// Its time derivative.
template <class X>
X cubic_hermite_slope(double s, double h, const X& x0, const X& d0, const X& x1, const X& d1) {
  const double r = 1 - s;
  const X change = x1 - x0;
  return 6 * s * r / h * change + r * (1 - 3 * s) * d0 + s * (3 * s - 2) * d1;
}

}  // namespace pintle
