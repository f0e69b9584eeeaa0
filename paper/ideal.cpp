#include "paper/ideal.h"

#include <cmath>
#include <vector>

namespace pintle::paper {
namespace {

constexpr double kG = 9.81, kR = 0.5, kJ = 1.0 / 3;  // of the pendulum, about its pin

// Jacobi's cn and dn by arithmetic-geometric means (Abramowitz and Stegun, 16.4).
struct Jacobi {
  double cn, dn;
};
Jacobi jacobi(double u, double modulus) {
  std::vector<double> a{1}, c{modulus};
  double b = std::sqrt(1 - modulus * modulus);
  while (std::abs(c.back()) > 1e-16 && a.size() < 20) {
    const double mean = (a.back() + b) / 2;
    c.push_back((a.back() - b) / 2);
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
  }
  std::size_t n = a.size() - 1;
  double phi = std::ldexp(a[n] * u, static_cast<int>(n));
  for (; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  const double sn = std::sin(phi);
  return {std::cos(phi), std::sqrt(1 - modulus * modulus * sn * sn)};
}

double cross(const Force& a, const Force& b) {
  return a.x * b.y - a.y * b.x;
}

// Unit vector at an angle, and its derivative by the angle.
Force along(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
Force across(double angle) {
  return {-std::sin(angle), std::cos(angle)};
}
Force sum(double p, const Force& a, double q, const Force& b) {
  return {p * a.x + q * b.x, p * a.y + q * b.y};
}

constexpr double kA = 1, kB = 4, kC = 4, kD = 6;                       // crank, coupler, follower, ground
constexpr double kM2 = 1, kM3 = 4, kM4 = 4, kI2 = 1e5, kI3 = 5.333, kI4 = 5.333;

// Everything that follows from the crank's angle alone; slopes are derivatives by it.
struct Linkage {
  double theta3, theta4;
  double h3, h4, slope3, slope4;  // omega3/omega2, omega4/omega2 and their slopes
  Force g3, slope_g3;             // of the coupler's centre
  double J, slope_J;              // kinetic energy is J omega2^2 / 2

  explicit Linkage(double theta2) {
    const Force end = {kA * std::cos(theta2), kA * std::sin(theta2)};
    const double dx = kD - end.x, dy = -end.y, s = std::hypot(dx, dy);
    const double to_foot = (s * s + kB * kB - kC * kC) / (2 * s), height = std::sqrt(kB * kB - to_foot * to_foot);
    const double bx = (to_foot * dx - height * dy) / s, by = (to_foot * dy + height * dx) / s;  // from the crank's end
    theta3 = std::atan2(by, bx);
    theta4 = std::atan2(end.y + by, end.x + bx - kD);
    const double sine = std::sin(theta3 - theta4), cosine = std::cos(theta3 - theta4);
    h3 = kA * std::sin(theta4 - theta2) / (kB * sine);
    h4 = -kA * std::sin(theta2 - theta3) / (kC * sine);
    slope3 = -(kA * std::cos(theta2 - theta4) + kB * h3 * h3 * cosine - kC * h4 * h4) / (kB * sine);
    slope4 = (-kA * std::cos(theta2 - theta3) - kB * h3 * h3 + kC * h4 * h4 * cosine) / (kC * sine);
    g3 = sum(kA, across(theta2), kB / 2 * h3, across(theta3));
    slope_g3 = sum(-kA, along(theta2), kB / 2 * slope3, across(theta3));
    slope_g3 = sum(1, slope_g3, -kB / 2 * h3 * h3, along(theta3));
    const double pivot4 = kI4 + kM4 * kC * kC / 4;
    J = kI2 + kM2 * kA * kA / 4 + kM3 * (g3.x * g3.x + g3.y * g3.y) + kI3 * h3 * h3 + pivot4 * h4 * h4;
    slope_J = 2 * (kM3 * (g3.x * slope_g3.x + g3.y * slope_g3.y) + kI3 * h3 * slope3 + pivot4 * h4 * slope4);
  }
};

}  // namespace

const std::array<const char*, 4> kFourBarPins{"joint.O2.on_crank", "joint.A.on_coupler", "joint.B.on_follower",
                                              "joint.O4.on_follower"};

// sin(theta/2) = m cd(w t), m = sin 45 deg: the swing of a pendulum from rest.
IdealPendulum ideal_pendulum(double t) {
  const double modulus = std::sqrt(0.5), w = std::sqrt(kG * kR / kJ);
  const Jacobi j = jacobi(w * t, modulus);
  const double theta = 2 * std::asin(modulus * j.cn / j.dn);
  return ideal_pendulum_at(theta);
}

IdealPendulum ideal_pendulum_at(double theta) {
  const double c = std::cos(theta), s = std::sin(theta), square = 2 * kG * kR / kJ * c, alpha = -kG * kR / kJ * s;
  return {theta, std::sqrt(std::max(0.0, square)), -(kG + kR * (square * c + alpha * s)), kR * (alpha * c - square * s)};
}

IdealFourBar ideal_four_bar(double theta2, double theta_start, double omega_start) {
  const Linkage l(theta2), start(theta_start);
  IdealFourBar out{};
  out.theta3 = l.theta3;
  out.theta4 = l.theta4;
  out.omega2 = omega_start * std::sqrt(start.J / l.J);
  out.omega3 = l.h3 * out.omega2;
  out.omega4 = l.h4 * out.omega2;
  const double square = out.omega2 * out.omega2;
  out.alpha2 = -0.5 * l.slope_J / l.J * square;
  out.alpha3 = l.h3 * out.alpha2 + l.slope3 * square;
  out.alpha4 = l.h4 * out.alpha2 + l.slope4 * square;
  const Force e3 = along(l.theta3), e4 = along(l.theta4);
  const Force a2 = sum(kA / 2 * out.alpha2, across(theta2), -kA / 2 * square, along(theta2));
  const Force a3 = sum(out.alpha2, l.g3, square, l.slope_g3);
  const Force a4 = sum(kC / 2 * out.alpha4, across(l.theta4), -kC / 2 * out.omega4 * out.omega4, e4);
  // Moments of the follower about O4 and of the coupler about the crank's end give the force at B on the follower.
  const double moment4 = (kI4 + kM4 * kC * kC / 4) * out.alpha4 / kC;
  const double moment3 = -(kI3 * out.alpha3 + kM3 * kB / 2 * cross(e3, a3)) / kB;
  const double det = cross(e3, e4);
  Force b{(moment3 * e4.x - moment4 * e3.x) / det, (moment3 * e4.y - moment4 * e3.y) / det};
  const Force a = sum(kM3, a3, 1, b);
  out.force = {sum(kM2, a2, 1, a), a, b, sum(kM4, a4, -1, b)};
  return out;
}

}  // namespace pintle::paper
