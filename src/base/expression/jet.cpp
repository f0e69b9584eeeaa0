#include "base/expression/jet.h"

#include <cmath>
#include <limits>

namespace pintle {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// Partial derivatives of a function of one and of two arguments.
struct Slopes1 {
  double a, aa;
};
struct Slopes2 {
  double a, b, aa, ab, bb;
};

// The sign of a quantity just beyond the present point.
double sign_behind(const Jet& a) {
  if (a.value != 0) return apply(Op::kSign, a.value);
  return apply(Op::kSign, a.first != 0 ? a.first : a.second);
}

// factor * derivative; zero if the derivative is zero.
double times(double factor, double derivative) {
  return derivative == 0 ? 0 : factor * derivative;
}

Jet chain(double value, const Slopes1& f, const Jet& a) {
  return {value, times(f.a, a.first), times(f.aa, a.first * a.first) + times(f.a, a.second)};
}

Jet chain(double value, const Slopes2& f, const Jet& a, const Jet& b) {
  const double first = times(f.a, a.first) + times(f.b, b.first);
  const double bent =
      times(f.aa, a.first * a.first) + 2 * times(f.ab, a.first * b.first) + times(f.bb, b.first * b.first);
  return {value, first, bent + times(f.a, a.second) + times(f.b, b.second)};
}

Slopes1 slopes_of(Op op, double x, double f) {
  switch (op) {
    case Op::kNegate:
      return {-1, 0};
    case Op::kSin:
      return {std::cos(x), -f};
    case Op::kCos:
      return {-std::sin(x), -f};
    case Op::kTan:
      return {1 + f * f, 2 * f * (1 + f * f)};
    case Op::kAsin:
      return {1 / std::sqrt(1 - x * x), x / std::pow(1 - x * x, 1.5)};
    case Op::kAcos:
      return {-1 / std::sqrt(1 - x * x), -x / std::pow(1 - x * x, 1.5)};
    case Op::kAtan:
      return {1 / (1 + x * x), -2 * x / ((1 + x * x) * (1 + x * x))};
    case Op::kSinh:
      return {std::cosh(x), f};
    case Op::kCosh:
      return {std::sinh(x), f};
    case Op::kTanh:
      return {1 - f * f, -2 * f * (1 - f * f)};
    case Op::kExp:
      return {f, f};
    case Op::kLog:
      return {1 / x, -1 / (x * x)};
    case Op::kSqrt:
      return {0.5 / f, -0.25 / (f * x)};
    case Op::kSign:
    case Op::kStep:
      return {0, 0};
    default:
      return {kNoNumber, kNoNumber};
  }
}

// n x^m; zero if n is zero.
double scaled_power(double n, double x, double m) {
  return n == 0 ? 0 : n * std::pow(x, m);
}

// d/db a^b = a^b log a; if the power is zero, so are its derivatives by b.
Slopes2 power_slopes(double a, double b, double f) {
  const double log_a = f == 0 ? 0 : std::log(a);
  const double slope = scaled_power(b, a, b - 1);
  const double mixed = f == 0 ? 0 : std::pow(a, b - 1) + slope * log_a;
  return {slope, f * log_a, scaled_power(b * (b - 1), a, b - 2), mixed, f * log_a * log_a};
}

Slopes2 atan2_slopes(double y, double x) {
  const double r2 = x * x + y * y;
  const double bend = 2 * (x / r2) * (y / r2);
  return {x / r2, -y / r2, -bend, (y - x) / r2 * ((y + x) / r2), bend};
}

Slopes2 slopes_of(Op op, double a, double b, double f) {
  switch (op) {
    case Op::kAdd:
      return {1, 1, 0, 0, 0};
    case Op::kSubtract:
      return {1, -1, 0, 0, 0};
    case Op::kMultiply:
      return {b, a, 0, 1, 0};
    case Op::kDivide:
      return {1 / b, -f / b, 0, -1 / (b * b), 2 * f / (b * b)};
    case Op::kPower:
      return power_slopes(a, b, f);
    case Op::kAtan2:
      return atan2_slopes(a, b);
    default:
      return {kNoNumber, kNoNumber, kNoNumber, kNoNumber, kNoNumber};
  }
}

Jet smoothstep(const Jet& a, const Jet& b, const Jet& x) {
  const double value = apply(Op::kSmoothstep, a.value, b.value, x.value);
  const Jet s = apply(Op::kDivide, apply(Op::kSubtract, x, a), apply(Op::kSubtract, b, a));
  const bool is_flat = a.value == b.value || s.value <= 0 || s.value >= 1;
  if (is_flat) return {value, 0, 0};
  return chain(value, Slopes1{6 * s.value * (1 - s.value), 6 - 12 * s.value}, s);
}

}  // namespace

Jet apply(const TableFunction& table, const Jet& a) {
  const TableFunction::Values f = table.at(a.value);
  return chain(f.value, Slopes1{f.first, f.second}, a);
}

Jet apply(Op op, const Jet& a) {
  const double value = apply(op, a.value);
  return chain(value, op == Op::kAbs ? Slopes1{sign_behind(a), 0} : slopes_of(op, a.value, value), a);
}

Jet apply(Op op, const Jet& a, const Jet& b) {
  const double value = apply(op, a.value, b.value);
  switch (op) {
    case Op::kMin:
      return std::isnan(b.value) || sign_behind(apply(Op::kSubtract, b, a)) < 0 ? b : a;
    case Op::kMax:
      return std::isnan(b.value) || sign_behind(apply(Op::kSubtract, b, a)) > 0 ? b : a;
    case Op::kLess:
    case Op::kGreater:
    case Op::kLessEqual:
    case Op::kGreaterEqual:
      return {value, 0, 0};
    default:
      return chain(value, slopes_of(op, a.value, b.value, value), a, b);
  }
}

Jet apply(Op op, const Jet& a, const Jet& b, const Jet& c) {
  if (op == Op::kSmoothstep) return smoothstep(a, b, c);
  if (op != Op::kIf || std::isnan(a.value)) return {kNoNumber, kNoNumber, kNoNumber};
  return a.value != 0 ? b : c;
}

}  // namespace pintle
