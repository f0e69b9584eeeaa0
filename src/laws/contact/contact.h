// The normal force of two bodies in contact, from the depth d by which they overlap and its rate.
//
//   N = K d^n (1 + g d') + c d'          theory/contact Eq. (1.1)
//   V = K d^(n+1) / (n+1)                Eq. (1.2)
//   g = h / v                            Eq. (1.3)
//   c = c_0 (3 x^2 - 2 x^3),  x = min(1, d/L)                  Eq. (1.4), if the damping grows over a cushion's length L; else c = c_0
//
// v is the approach speed: d' at the touch, kept for as long as the bodies touch; in (1.3) it is at least the floor. It is a state of the law, 0 while they
// are apart. Where N < 0 the bodies would attract each other: N = 0 instead, and the remaining elastic power is lost, unless attraction is wanted.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "laws/law_math.h"

namespace pintle {

/// The coefficient of restitution e of a free impact with N = K d^n (1 + h d'/v), independent of K, n, mass and speed: the
/// root of h (1 + e) = ln((1 + h) / (1 - h e)). theory/contact Eq. (2.3). For h >= 0 [-].
double restitution_of(double hysteresis);

/// The published formulas for h from the desired restitution; kExact is the inverse of restitution_of.
enum class ContactModel { kExact, kLankaraniNikravesh, kHuntCrossley, kFlores, kGonthier, kViscous };
/// h according to a model for a restitution 0 < e <= 1; kViscous has none. theory/contact Eqs. (2.4)-(2.7).
double hysteresis_of(ContactModel model, double restitution);

/// K of Hertz' contact of a cylinder's end or sphere of radius R_j in a concave surface of radius R_b > R_j, or on a flat one (infinite R_b), of the same
/// material [N/m^1.5]: 4/3 E/(2 (1 - nu^2)) sqrt(R_j R_b/(R_b - R_j)). As used by H. M. Lankarani and P. E. Nikravesh, ASME J. Mech. Des. 112 (1990) 369-376.
double hertz_stiffness(double modulus, double poisson, double journal, double bearing);

struct ContactForce {
  static constexpr int kBorders = 3, kTouch = 0, kLetGo = 1;
  static constexpr std::array<int, kBorders> kDirections{1, -1, 0};
  double stiffness = 1e10;     // K [N/m^n]
  double exponent = 1.5;       // n [-]
  double hysteresis = 0;       // h [-]
  double fixed_damping = 0;    // g, if it does not depend on the approach speed [s/m]
  double viscous = 0;          // c_0 [N*s/m]
  double cushion = 0;          // L; 0: all of c_0 acts from the touch [m]
  double least_approach = 1e-3;  // floor of v [m/s]
  bool attracts = false;

  /// g for a contact that began with this approach speed.
  template <class T>
  T damping(const T& approach) const {
    return T(fixed_damping) + law_math::divide(T(hysteresis), law_math::where_positive(approach - T(least_approach), approach, T(least_approach)));
  }
  /// c at this depth.
  template <class T>
  T viscous_at(const T& depth) const {
    if (!(cushion > 0)) return T(viscous);
    const T share = (1 / cushion) * depth, x = law_math::where_positive(share - T(1.0), T(1.0), share);
    return viscous * (x * x * (T(3.0) - 2.0 * x));                                                              // (1.4)
  }
  /// d at which N has this value at rest.
  double depth_at(double pressing) const { return std::pow(pressing / stiffness, 1 / exponent); }
  /// N for d > 0.
  template <class T>
  T force(const T& depth, const T& rate, const T& approach) const {
    using namespace law_math;
    const T elastic = stiffness * pow(depth, exponent), whole = elastic * (T(1.0) + damping(approach) * rate) + viscous_at(depth) * rate;
    return attracts ? whole : where_positive(whole, whole, T(0.0));
  }
  template <class T>
  T elastic_force(const T& depth) const { return stiffness * law_math::pow(depth, exponent); }
  template <class T>
  T energy(const T& depth) const { return (stiffness / (exponent + 1)) * law_math::pow(depth, exponent + 1); }
  /// Positive where the force is positive.
  double pressing(double depth, double rate, double approach) const {
    if (attracts) return 1;
    if (cushion > 0) return depth > 0 ? 1 + viscous_at(depth) / elastic_force(depth) * rate : 1;
    if (viscous > 0) return depth + (viscous / stiffness) * rate;  // contacts of this kind have n = 1 and no h
    return 1 + damping(approach) * rate;
  }
  /// The borders of one contact whose approach speed is `approach`: touch, let-go, and the force vanishing although the bodies overlap.
  void borders(double depth, double rate, double approach, double* value) const {
    const bool touching = approach > 0;
    value[0] = touching ? -1 : depth;
    value[1] = touching ? depth : 1;
    value[2] = touching ? pressing(depth, rate, approach) : 1;
  }
  static constexpr std::string_view border_name(int border, bool rising) {
    return border == kTouch ? "touch" : border == kLetGo ? "let-go" : rising ? "force returns" : "force vanishes";
  }
  /// Updates the approach speed when that border has been crossed, at this rate.
  void cross(int border, double rate, double& approach) const {
    if (border == kTouch) approach = std::max(rate, std::numeric_limits<double>::min());  // however slow, they touch now
    if (border == kLetGo) approach = 0;
  }
  /// The stiffness at a depth, for callers that only need to know how stiff a joint is [N/m].
  static constexpr double kUsualDepth = 1e-6;  // depth at which the stiffness represents the contact's in guesses, checks and errors [m]
  double stiffness_at(double depth) const { return stiffness * exponent * std::pow(depth, exponent - 1); }
};

/// Coulomb friction with a ramp, J. A. C. Ambrosio, Impact of rigid and flexible multibody systems, in: Virtual Nonlinear Multibody Systems, NATO
/// ASI (2002): none below a slip speed of v_0, in full above v_1. theory/contact Eq. (3.1).
struct RampedFriction {
  double coefficient = 0;        // mu [-]
  double start = 0, end = 1e-3;  // v_0, v_1 [m/s]

  /// -mu N c(|v|) sign(v) for a slip v.
  template <class T>
  T force(const T& normal, const T& slip) const {
    using namespace law_math;
    if (coefficient == 0) return T(0.0);
    const T size = abs(slip), beyond = where_positive(slip, slip - T(start), slip + T(start));
    const T ramp = (1 / (end - start)) * where_positive(T(start) - size, T(0.0), beyond);  // with v_0 = 0 its slope at rest is that of the ramp
    return -coefficient * (normal * where_positive(size - T(end), where_positive(slip, T(1.0), T(-1.0)), ramp));
  }
};

/// Two surfaces at the point where they may touch.
template <class T>
struct ContactMotion {
  T depth, rate, slip;  // overlap, negative while apart; its rate; speed along each other [m, m/s, m/s]
};

/// Forces between them, all zero while they are apart; the caller adds the friction.
template <class T>
struct PointForces {
  T normal, friction;  // N >= 0 unless they attract; friction along the slip, opposing it [N]
  T energy, loss;      // [J, W]
};
template <class T>
PointForces<T> point_forces(const ContactForce& contact, const ContactMotion<T>& at, const T& approach) {
  using namespace law_math;
  const T none(0.0), touching = where_positive(approach, at.depth, T(-1.0)), depth = where_positive(touching, at.depth, none);
  PointForces<T> f;
  f.normal = where_positive(touching, contact.force(depth, at.rate, approach), none);
  f.friction = none;
  f.energy = contact.energy(depth);
  f.loss = (f.normal - contact.elastic_force(depth)) * at.rate;
  return f;
}

}  // namespace pintle
