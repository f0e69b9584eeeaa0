// The functions in which laws are written, for plain numbers, dual numbers and lanes.
#pragma once

#include <cmath>

#include "base/dual.h"
#include "simd/lanes.h"

namespace pintle::law_math {

inline double value_of(double x) { return x; }
template <int M>
double value_of(const Dual<M>& x) { return x.v; }

template <int N, class F>
Lanes<N> each(const Lanes<N>& x, F f) {
  Lanes<N> r;
  for (int i = 0; i < N; ++i) r.set(i, f(x[i]));
  return r;
}

/// Adds a x, or a x^2, to a sum.
template <class T>
void add(double a, const T& x, T& sum) { sum += a * x; }
template <int M>
void add(double a, const Dual<M>& x, Dual<M>& sum) { sum.add(a * x.v, a, x); }
template <class T>
void add_square(double a, const T& x, T& sum) { sum += a * (x * x); }
template <int M>
void add_square(double a, const Dual<M>& x, Dual<M>& sum) { sum.add(a * (x.v * x.v), 2 * a * x.v, x); }

/// f(x), where `slope` is the derivative of f.
template <class F, class D>
double through(double x, F f, D) { return f(x); }
template <int M, class F, class D>
Dual<M> through(const Dual<M>& x, F f, D slope) { return Dual<M>::scaled(f(x.v), slope(x.v), x); }
template <int N, class F, class D>
Lanes<N> through(const Lanes<N>& x, F f, D) { return each(x, f); }

/// Values of a function of several numbers, with its derivatives by each.
template <int In, int Out>
struct Slopes {
  double value[Out] = {};
  double slope[Out][In] = {};
};

/// y = f(x) for several numbers at once, where f(x, with_slopes) works on plain numbers and returns Slopes.
template <int In, int Out, class F>
void through(const double (&x)[In], F f, double (&y)[Out]) {
  const Slopes<In, Out> at = f(x, false);
  for (int i = 0; i < Out; ++i) y[i] = at.value[i];
}
template <int M, int In, int Out, class F>
void through(const Dual<M> (&x)[In], F f, Dual<M> (&y)[Out]) {
  double plain[In];
  for (int k = 0; k < In; ++k) plain[k] = x[k].v;
  const Slopes<In, Out> at = f(plain, true);
  for (int i = 0; i < Out; ++i) {
    y[i] = Dual<M>(at.value[i]);
    for (int k = 0; k < In; ++k)
      for (int m = 0; m < M; ++m) y[i].d[m] += at.slope[i][k] * x[k].d[m];
  }
}
template <int N, int In, int Out, class F>
void through(const Lanes<N> (&x)[In], F f, Lanes<N> (&y)[Out]) {
  for (int lane = 0; lane < N; ++lane) {
    double plain[In];
    for (int k = 0; k < In; ++k) plain[k] = x[k][lane];
    const Slopes<In, Out> at = f(plain, false);
    for (int i = 0; i < Out; ++i) y[i].set(lane, at.value[i]);
  }
}

inline double abs(double x) { return std::abs(x); }
inline double sqrt(double x) { return std::sqrt(x); }
/// 0 where hardly any digits are left: the library takes ten times as long there.
inline double exp(double x) {
  constexpr double kNothing = -700;  // its exponential is 1e-304
  return x < kNothing ? 0 : std::exp(x);
}
inline double tanh(double x) { return std::tanh(x); }
inline double sin(double x) { return std::sin(x); }
inline double cos(double x) { return std::cos(x); }
/// For x >= 0. The powers of Hertz's contact, of its stiffness and of its energy need no logarithm, which takes ten times as long as a root.
inline double pow(double x, double p) {
  if (p == 0.5) return std::sqrt(x);
  if (p == 1.5) return x * std::sqrt(x);
  if (p == 2.5) return x * x * std::sqrt(x);
  return std::pow(x, p);
}
inline double divide(double a, double b) { return a / b; }
/// x where a > 0, else y.
inline double where_positive(double a, double x, double y) { return a > 0 ? x : y; }

template <int M>
Dual<M> abs(const Dual<M>& x) { return x.v < 0 ? -x : x; }
/// At zero the slope is taken as zero.
template <int M>
Dual<M> sqrt(const Dual<M>& x) {
  const double root = std::sqrt(x.v);
  return Dual<M>::scaled(root, root > 0 ? 0.5 / root : 0, x);
}
template <int M>
Dual<M> exp(const Dual<M>& x) {
  const double e = exp(x.v);
  return Dual<M>::scaled(e, e, x);
}
template <int M>
Dual<M> tanh(const Dual<M>& x) {
  const double y = std::tanh(x.v);
  return Dual<M>::scaled(y, 1 - y * y, x);
}
template <int M>
Dual<M> sin(const Dual<M>& x) { return Dual<M>::scaled(std::sin(x.v), std::cos(x.v), x); }
template <int M>
Dual<M> cos(const Dual<M>& x) { return Dual<M>::scaled(std::cos(x.v), -std::sin(x.v), x); }
template <int M>
Dual<M> pow(const Dual<M>& x, double p) {
  const double less = pow(x.v, p - 1);
  return Dual<M>::scaled(x.v * less, p * less, x);
}
template <int M>
Dual<M> divide(const Dual<M>& a, const Dual<M>& b) { return a / b; }
template <int M>
Dual<M> where_positive(const Dual<M>& a, const Dual<M>& x, const Dual<M>& y) { return a.v > 0 ? x : y; }

template <int N>
Lanes<N> abs(const Lanes<N>& x) { return sizes(x); }
template <int N>
Lanes<N> sqrt(const Lanes<N>& x) { return each(x, [](double v) { return std::sqrt(v); }); }
template <int N>
Lanes<N> exp(const Lanes<N>& x) { return each(x, [](double v) { return exp(v); }); }
template <int N>
Lanes<N> tanh(const Lanes<N>& x) { return each(x, [](double v) { return std::tanh(v); }); }
template <int N>
Lanes<N> sin(const Lanes<N>& x) { return each(x, [](double v) { return std::sin(v); }); }
template <int N>
Lanes<N> cos(const Lanes<N>& x) { return each(x, [](double v) { return std::cos(v); }); }
template <int N>
Lanes<N> pow(const Lanes<N>& x, double p) { return each(x, [p](double v) { return pow(v, p); }); }
template <int N>
Lanes<N> divide(const Lanes<N>& a, const Lanes<N>& b) { return {a.v / b.v}; }
template <int N>
Lanes<N> where_positive(const Lanes<N>& a, const Lanes<N>& x, const Lanes<N>& y) { return where_larger(a, Lanes<N>::all(0), x, y); }

inline double atan2(double y, double x) { return std::atan2(y, x); }
template <int M>
Dual<M> atan2(const Dual<M>& y, const Dual<M>& x) {
  const double square = x.v * x.v + y.v * y.v;
  Dual<M> r = (x.v / square) * y - (y.v / square) * x;
  r.v = std::atan2(y.v, x.v);
  return r;
}
template <int N>
Lanes<N> atan2(const Lanes<N>& y, const Lanes<N>& x) {
  Lanes<N> r;
  for (int i = 0; i < N; ++i) r.set(i, std::atan2(y[i], x[i]));
  return r;
}

}  // namespace pintle::law_math
