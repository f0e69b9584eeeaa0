// Scalar gaps that are functions of the relative pose z = (x, y, angle) of M in F: value, gradient, second derivative.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "space/space.h"

namespace pintle {

template <class S>
struct BasicGapFunction {
  double gap = 0;
  typename S::Vec gradient = S::Vec::Zero();
  typename S::Mat hessian = S::Mat::Zero();
};
using GapFunction = BasicGapFunction<Planar>;

/// The turn of the second frame relative to the first.
inline GapFunction turn_of(const Planar::Vec& z) {
  GapFunction g;
  g.gap = z[2];
  g.gradient[2] = 1;
  return g;
}

/// Calls use(component, function) for the functions of the pose that p has: its gap and its free functions, which are an opening and a turn, or a slip.
template <class P, class Vec, class Use>
void visit_functions(const P& p, const Vec& z, Use&& use) {
  if constexpr (requires { p.gap_and_slip(z); }) {
    const auto both = p.gap_and_slip(z);
    use(0, both[0]);
    use(1, both[1]);
  } else {
    use(0, p(z));
    if constexpr (requires { p.opening(z); }) {
      if (p.gap_functions() > 1) use(1, p.opening(z));
      if (p.gap_functions() > 2) use(2, turn_of(z));
    }
  }
}

/// Rod and rope: the distance of the two points minus the length. theory/joints Eq. (2.11). At zero distance, where the
/// direction is undefined, F's x axis is used.
template <class S>
struct BasicDistance {
  double length = 1;  // [m]

  BasicGapFunction<S> operator()(const typename S::Vec& z) const {
    BasicGapFunction<S> g;
    double distance = std::hypot(z[0], z[1]);
    for (int k = 2; k < S::kDim; ++k) distance = std::hypot(distance, z[k]);
    g.gap = distance - length;
    if (distance < 1e-300) {
      g.gradient[0] = 1;
      return g;
    }
    for (int k = 0; k < S::kDim; ++k) g.gradient[k] = z[k] / distance;
    for (int i = 0; i < S::kDim; ++i)
      for (int k = 0; k < S::kDim; ++k) {
        double sum = 0;  // of the squares of the other components: free of cancellation
        for (int c = 0; c < S::kDim && i == k; ++c) sum += c == i ? 0 : g.gradient[c] * g.gradient[c];
        g.hessian(i, k) = (i == k ? sum : -g.gradient[i] * g.gradient[k]) / distance;
      }
    return g;
  }
};
using Distance = BasicDistance<Planar>;

/// Two gears in mesh, centred on F and M: the slip of their pitch circles. Eq. (2.12).
///   gap = sign r2 angle - (r1 + sign r2) direction of the line of centres + phase, sign = +1 external, -1 internal
struct Mesh {
  double radius_first = 1, radius_second = 1;  // pitch radii [m]
  double sign = 1;
  double phase = 0;                            // makes the gap zero as assembled [m]
  bool opens = false;                          // teeth push the gears apart: the opening is a component
  bool rubs = false;                           // teeth have friction: the turn is a component

  int gap_functions() const { return rubs ? 3 : opens ? 2 : 1; }
  /// How much farther apart the centres are (nearer, in an internal mesh) than where the pitch circles touch. Eq. (2.20)
  GapFunction opening(const Planar::Vec& z) const {
    GapFunction g = Distance{std::abs(radius_first + sign * radius_second)}(z);
    g.gap *= sign;
    g.gradient *= sign;
    g.hessian *= sign;
    return g;
  }

  GapFunction operator()(const Planar::Vec& z) const {
    GapFunction g;
    const double r2 = sign * radius_second, sum = radius_first + r2;
    const double d2 = z[0] * z[0] + z[1] * z[1];
    g.gap = r2 * z[2] - sum * std::atan2(z[1], z[0]) + phase;
    const double turn = 2 * std::numbers::pi * std::abs(sum);  // the direction is known up to full turns
    if (turn > 0) g.gap -= turn * std::round(g.gap / turn);
    g.gradient << sum * z[1] / d2, -sum * z[0] / d2, r2;
    const double a = sum / (d2 * d2);
    g.hessian(0, 0) = -2 * a * z[0] * z[1];
    g.hessian(1, 1) = 2 * a * z[0] * z[1];
    g.hessian(0, 1) = g.hessian(1, 0) = a * (z[0] * z[0] - z[1] * z[1]);
    return g;
  }
};

/// A pinion centred on F that rolls along the x axis of M: its slip. Eq. (2.13).
///   gap = -(x cos angle + y sin angle) - side radius angle + phase; side = +1 with the pinion on the rack's +y side
struct RackMesh {
  double radius = 1;  // [m]
  double side = 1;
  double phase = 0;   // [m]
  bool opens = false;  // teeth push the pinion off the rack: the opening is a component
  bool rubs = false;   // teeth have friction: the turn is a component

  int gap_functions() const { return rubs ? 3 : opens ? 2 : 1; }
  /// How much farther the pinion's centre is from the rack than its pitch radius. Eq. (2.20)
  GapFunction opening(const Planar::Vec& z) const {
    GapFunction g;
    const double c = side * std::cos(z[2]), s = side * std::sin(z[2]);
    const double along = z[0] * c + z[1] * s, across = z[0] * s - z[1] * c;
    g.gap = across - radius;
    g.gradient << s, -c, along;
    g.hessian(2, 2) = -across;
    g.hessian(0, 2) = g.hessian(2, 0) = c;
    g.hessian(1, 2) = g.hessian(2, 1) = s;
    return g;
  }

  GapFunction operator()(const Planar::Vec& z) const {
    GapFunction g;
    const double c = std::cos(z[2]), s = std::sin(z[2]);
    const double along = z[0] * c + z[1] * s, across = -z[0] * s + z[1] * c;
    g.gap = -along - side * radius * z[2] + phase;
    g.gradient << -c, -s, -across - side * radius;
    g.hessian(2, 2) = along;
    g.hessian(0, 2) = g.hessian(2, 0) = s;
    g.hessian(1, 2) = g.hessian(2, 1) = -c;
    return g;
  }
};

/// Any other function of the pose, by its address and up to four numbers: the gap of a joint type registered from outside.
struct FunctionGap {
  GapFunction (*at)(const Planar::Vec& z, const double* parameters) = nullptr;
  std::array<double, 4> parameters{};
  double period = 0;  // the pose determines the gap up to multiples of this; 0: uniquely

  GapFunction operator()(const Planar::Vec& z) const { return at(z, parameters.data()); }
};

class CamProfile;

/// A cam and its follower: their distance along their common normal, negative where they overlap, and the speed of their slip along each other.
/// theory/cams Eqs. (2.2)-(2.9). The profile belongs to the joint.
struct CamGap {
  const CamProfile* profile = nullptr;

  static int gap_functions() { return 2; }
  std::array<GapFunction, 2> gap_and_slip(const Planar::Vec& z) const;
};

class EdgeProfile;

/// The same for a pin, roller or wheel and the curved edge below it. theory/cams section 4. The profile belongs to the joint.
struct EdgeGap {
  const EdgeProfile* profile = nullptr;

  static int gap_functions() { return 2; }
  std::array<GapFunction, 2> gap_and_slip(const Planar::Vec& z) const;
};

}  // namespace pintle
