// Rotations in space by their exponential map: matrices and vectors over any number type T (plain numbers, lanes, dual numbers), the
// rotation vector of an orientation, and its rate. E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, Springer 2006,
// section IV.8; theory/space section 1.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "simd/lanes.h"

namespace pintle {

template <class T>
struct Vector3 {
  T x, y, z;
};
template <class T>
Vector3(T, T, T) -> Vector3<T>;

/// By rows.
template <class T>
struct Matrix3 {
  T xx, xy, xz, yx, yy, yz, zx, zy, zz;
};
template <class T>
Matrix3(T, T, T, T, T, T, T, T, T) -> Matrix3<T>;

template <class T, class U>
PINTLE_LANES auto operator+(const Vector3<T>& a, const Vector3<U>& b) { return Vector3{a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T, class U>
PINTLE_LANES auto operator-(const Vector3<T>& a, const Vector3<U>& b) { return Vector3{a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T, class U>
PINTLE_LANES auto operator*(const T& f, const Vector3<U>& a) { return Vector3{f * a.x, f * a.y, f * a.z}; }
template <class T, class U>
PINTLE_LANES auto cross(const Vector3<T>& a, const Vector3<U>& b) {
  return Vector3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// R a.
template <class T, class U>
PINTLE_LANES auto operator*(const Matrix3<T>& R, const Vector3<U>& a) {
  return Vector3{R.xx * a.x + R.xy * a.y + R.xz * a.z, R.yx * a.x + R.yy * a.y + R.yz * a.z, R.zx * a.x + R.zy * a.y + R.zz * a.z};
}
/// R' a.
template <class T, class U>
PINTLE_LANES auto turned_back(const Matrix3<T>& R, const Vector3<U>& a) {
  return Vector3{R.xx * a.x + R.yx * a.y + R.zx * a.z, R.xy * a.x + R.yy * a.y + R.zy * a.z, R.xz * a.x + R.yz * a.y + R.zz * a.z};
}
template <class T, class U>
PINTLE_LANES auto operator*(const Matrix3<T>& A, const Matrix3<U>& B) {
  const auto x = A * Vector3<U>{B.xx, B.yx, B.zx}, y = A * Vector3<U>{B.xy, B.yy, B.zy}, z = A * Vector3<U>{B.xz, B.yz, B.zz};
  return Matrix3{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

/// Conversions between Eigen's matrices and these.
inline Vector3<double> components(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }
inline Eigen::Vector3d vector_of(const Vector3<double>& a) { return {a.x, a.y, a.z}; }
inline Matrix3<double> components(const Eigen::Matrix3d& R) { return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)}; }
template <class T>
Matrix3<T> identity3() { return {T(1.0), T(0.0), T(0.0), T(0.0), T(1.0), T(0.0), T(0.0), T(0.0), T(1.0)}; }

/// Functions of the square of a rotation's angle x: theory/space Eqs. (1.2), (1.4).
template <class T>
struct RotationFunctions {
  T once;     // sin x / x
  T twice;    // (1 - cos x) / x^2
  T inverse;  // (1 - x/2 cot x/2) / x^2
};

namespace rotation {

/// The Taylor series is used up to one radian, the closed forms for larger angles.
inline constexpr double kSmallSquare = 1;

/// c[0] + c[1] x + ... by Horner's rule.
template <class T, int n>
PINTLE_LANES T polynomial(const double (&c)[n], const T& x) {
  T sum = T(c[n - 1]);
  for (int i = n - 2; i >= 0; --i) sum = T(c[i]) + x * sum;
  return sum;
}

template <class T>
PINTLE_LANES RotationFunctions<T> of_small(const T& square) {
  constexpr double once[] = {1, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  constexpr double twice[] = {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800, -1.0 / 479001600, 1.0 / 87178291200, -1.0 / 20922789888000, 1.0 / 6402373705728000};
  // Bernoulli numbers: |B_2n| / (2n)!.
  constexpr double inverse[] = {1.0 / 12, 1.0 / 720, 1.0 / 30240, 1.0 / 1209600, 1.0 / 47900160, 691.0 / 1307674368000, 1.0 / 74724249600, 3617.0 / 10670622842880000,
                                43867.0 / 5109094217170944000, 174611.0 / 802857662698291200000.0};
  return {polynomial(once, square), polynomial(twice, square), polynomial(inverse, square)};
}

inline RotationFunctions<double> functions(double square) {
  if (square < kSmallSquare) return of_small(square);
  const double x = std::sqrt(square), s = std::sin(0.5 * x), c = std::cos(0.5 * x);
  return {2 * s * c / x, 2 * s * s / square, (1 - 0.5 * x * c / s) / square};
}
template <int N>
PINTLE_LANES RotationFunctions<Lanes<N>> functions(const Lanes<N>& square) {
  RotationFunctions<Lanes<N>> f = of_small(square);
  for (int i = 0; i < N; ++i) {
    if (square[i] < kSmallSquare) continue;
    const RotationFunctions<double> one = functions(square[i]);
    f.once.set(i, one.once);
    f.twice.set(i, one.twice);
    f.inverse.set(i, one.inverse);
  }
  return f;
}

/// The rotation by the vector `turn`, as a matrix. Eq. (1.2).
template <class T>
PINTLE_LANES Matrix3<T> matrix(const Vector3<T>& turn, const RotationFunctions<T>& f) {
  const T xx = turn.x * turn.x, yy = turn.y * turn.y, zz = turn.z * turn.z;
  const T xy = f.twice * (turn.x * turn.y), xz = f.twice * (turn.x * turn.z), yz = f.twice * (turn.y * turn.z);
  const T x = f.once * turn.x, y = f.once * turn.y, z = f.once * turn.z, one = T(1.0);
  return {one - f.twice * (yy + zz), xy - z, xz + y, xy + z, one - f.twice * (xx + zz), yz - x, xz - y, yz + x, one - f.twice * (xx + yy)};
}

/// The rate of a rotation vector that starts at the body's initial axes, for the angular velocity w in body axes. Eq. (1.4).
template <class T>
PINTLE_LANES Vector3<T> rate(const Vector3<T>& turn, const Vector3<T>& w, const T& inverse) {
  const Vector3<T> once = cross(turn, w);
  return w + 0.5 * once + inverse * cross(turn, once);
}

template <class T>
PINTLE_LANES T square_of(const Vector3<T>& a) { return a.x * a.x + a.y * a.y + a.z * a.z; }

/// The rotation as a unit quaternion. Eq. (1.1).
Eigen::Quaterniond quaternion(const Eigen::Vector3d& turn);

/// The rotation vector of a unit quaternion, of at most half a turn. Eq. (1.3).
Eigen::Vector3d vector_of(const Eigen::Quaterniond& r);

}  // namespace rotation
}  // namespace pintle
