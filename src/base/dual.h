// A number with its derivatives by M variables: the result of a formula carries its exact gradient (forward differentiation; A.
// Griewank and A. Walther, Evaluating Derivatives, SIAM 2008, chapter 3).
#pragma once

#include <cmath>

namespace pintle {

template <int M>
struct Dual {
  double v, d[M];

  Dual() = default;  // uninitialised, like a plain number
  explicit Dual(double value) : v(value), d{} {}
  /// The variable number `i` at `value`.
  static Dual variable(double value, int i) {
    Dual x(value);
    x.d[i] = 1;
    return x;
  }

  Dual& operator+=(const Dual& b) {
    add(b.v, 1, b);
    return *this;
  }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  friend Dual operator+(const Dual& a, const Dual& b) { return combined(a.v + b.v, 1, a, 1, b); }
  friend Dual operator-(const Dual& a, const Dual& b) { return combined(a.v - b.v, 1, a, -1, b); }
  friend Dual operator*(const Dual& a, const Dual& b) { return combined(a.v * b.v, b.v, a, a.v, b); }
  friend Dual operator/(const Dual& a, const Dual& b) { return combined(a.v / b.v, 1 / b.v, a, -a.v / (b.v * b.v), b); }
  friend Dual operator-(const Dual& a) { return scaled(-a.v, -1, a); }
  friend Dual operator*(double x, const Dual& a) { return scaled(x * a.v, x, a); }
  friend Dual operator*(const Dual& a, double x) { return x * a; }

  /// f(a), where df is the slope at a.
  static Dual scaled(double f, double df, const Dual& a) {
    Dual r;
    r.v = f;
    for (int i = 0; i < M; ++i) r.d[i] = df * a.d[i];
    return r;
  }
  /// Adds a function of a: its value f and its slope df there.
  void add(double f, double df, const Dual& a) {
    v += f;
    for (int i = 0; i < M; ++i) d[i] += df * a.d[i];
  }

 private:
  static Dual combined(double value, double by_a, const Dual& a, double by_b, const Dual& b) {
    Dual r;
    r.v = value;
    for (int i = 0; i < M; ++i) r.d[i] = by_a * a.d[i] + by_b * b.d[i];
    return r;
  }
};

}  // namespace pintle
