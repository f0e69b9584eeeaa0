// Bounds on the geometric stiffness of loaded joints, as stiffnesses of single bodies, of any sign. theory/time section 4.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "linalg/block.h"
#include "system/system.h"

namespace pintle {

/// How joints hold a body: against moving across them [N/m], against rotation by magnitude and with its sign [N*m/rad]. The last is
/// in space a symmetric matrix in world axes: xx, yy, zz, xy, xz, yz.
template <class S>
using BodyPull = BlockVec<double, S::kCurved ? 8 : 3>;

/// For joints whose gap is in the relative pose, at forces f in F's axes. Where a joint holds all components of a point, all that is
/// left of the geometric stiffness is, exactly, the rotation of its arms. Along a free component the force turns with one body while
/// the other slides. theory/time section 4.1.
template <class S, class Real>
struct PullAcross {
  Real turn_a, turn_b;  // against rotation: force times arm
  Real slide;           // the force across a free component
  Real arm_a, arm_b;

  PINTLE_LANES static PullAcross of(const PlanarGapMap<Real>& map, const Real* f, const Real* forbidden) {
    const Real x = map.c * f[0] - map.s * f[1], y = map.s * f[0] + map.c * f[1];
    PullAcross p;
    p.turn_a = -(map.ax * x + map.ay * y);
    p.turn_b = map.bx * x + map.by * y;
    p.slide = size(f[1]) - forbidden[0] * size(f[1]) + (size(f[0]) - forbidden[1] * size(f[0]));
    p.arm_a = size(map.ax) + size(map.ay);
    p.arm_b = size(map.bx) + size(map.by);
    return p;
  }
  /// The joint's stiffness against rotation of its first and its second body.
  PINTLE_LANES void add_turn_of_first(int lane, BodyPull<S>& pulled) const { pulled[2] += one(turn_a, lane); }
  PINTLE_LANES void add_turn_of_second(int lane, BodyPull<S>& pulled) const { pulled[2] += one(turn_b, lane); }
  PINTLE_LANES static double one(double x, int) { return x; }
  template <int N>
  PINTLE_LANES static double one(const Lanes<N>& x, int lane) { return x[lane]; }

 private:
  PINTLE_LANES static Real size(const Real& x) {
    if constexpr (std::is_same_v<Real, double>) return std::abs(x);
    else return sizes(x);
  }
};

/// In space a force F at an arm b contributes (F.b) |d|^2 - (F.d)(b.d) for a small rotation d; couples contribute at most their size.
/// theory/space Eq. (4.4).
template <class Real>
struct PullAcross<Spatial, Real> {
  Vector3<Real> force, reach_a, reach_b;
  Real couple, slide, arm_a, arm_b;

  PINTLE_LANES static PullAcross of(const SpatialGapMap<Real>& map, const Real* f, const Real* forbidden) {
    PullAcross p;
    p.force = map.RF * Vector3<Real>{f[0], f[1], f[2]};
    p.reach_a = map.arm_a;
    p.reach_b = map.arm_b;
    p.couple = size(f[3]) + size(f[4]) + size(f[5]);
    p.slide = Real(0.0);
    for (int k = 0; k < 3; ++k) p.slide += (Real(1.0) - forbidden[k]) * (size(f[(k + 1) % 3]) + size(f[(k + 2) % 3]));
    p.arm_a = size(map.arm_a.x) + size(map.arm_a.y) + size(map.arm_a.z);
    p.arm_b = size(map.arm_b.x) + size(map.arm_b.y) + size(map.arm_b.z);
    return p;
  }
  void add_turn_of_first(int lane, BodyPull<Spatial>& pulled) const { add_turn(lane, -1, reach_a, pulled); }
  void add_turn_of_second(int lane, BodyPull<Spatial>& pulled) const { add_turn(lane, 1, reach_b, pulled); }
  static double one(double x, int) { return x; }
  template <int N>
  static double one(const Lanes<N>& x, int lane) { return x[lane]; }

 private:
  void add_turn(int lane, double sign, const Vector3<Real>& reach, BodyPull<Spatial>& pulled) const {
    const double fx = sign * one(force.x, lane), fy = sign * one(force.y, lane), fz = sign * one(force.z, lane);
    const double bx = one(reach.x, lane), by = one(reach.y, lane), bz = one(reach.z, lane);
    pulled[1] += one(couple, lane);
    pulled[2] += fy * by + fz * bz;
    pulled[3] += fx * bx + fz * bz;
    pulled[4] += fx * bx + fy * by;
    pulled[5] -= 0.5 * (fx * by + fy * bx);
    pulled[6] -= 0.5 * (fx * bz + fz * bx);
    pulled[7] -= 0.5 * (fy * bz + fz * by);
  }
  PINTLE_LANES static Real size(const Real& x) {
    if constexpr (std::is_same_v<Real, double>) return std::abs(x);
    else return sizes(x);
  }
};

/// A force f across a slide x of a body that rotates by theta couples the two: f x theta is at most f (x^2 / r + r theta^2) / 2, here
/// with the radius of gyration r.
template <class S>
void add_slide(double f, double arm, int body, const BasicSystem<S>& system, std::vector<BodyPull<S>>& pulled) {
  if (body < 0 || body >= system.n_bodies()) return;
  const double radius = system.bodies[body].radius_of_gyration();
  pulled[body][0] += f / radius;
  pulled[body][1] += f * (radius + arm);
}

/// Stiffness of joint j of any kind at a force. Where the gap is a function of the pose, each body takes the sum of the
/// magnitudes in its rows, with rotations measured at the radii of gyration (Gershgorin).
template <class S>
void add_pull_of(int j, const BasicSystem<S>& system, const std::vector<typename S::Motion>& m, const typename S::Vec& force, std::vector<BodyPull<S>>& pulled);

/// The part of it that a step whose own frequency is `own` [1/s] does not resolve. theory/time Eq. (4.7).
inline Planar::Vec unresolved(const BodyPull<Planar>& pull, double own, const Planar::Vec& mass) {
  const double across = std::max(0.0, pull[0] - own * own * mass[0]);
  return {across, across, std::max(0.0, pull[1] + std::abs(pull[2]) - own * own * mass[2])};
}
inline Spatial::Vec unresolved(const BodyPull<Spatial>& pull, double own, const Spatial::Vec& mass) {
  const double cross = pull[5] * pull[5] + pull[6] * pull[6] + pull[7] * pull[7];
  const double turn = pull[1] + std::sqrt(pull[2] * pull[2] + pull[3] * pull[3] + pull[4] * pull[4] + 2 * cross);
  Spatial::Vec held;
  for (int k = 0; k < Spatial::kDof; ++k) held[k] = std::max(0.0, (k < Spatial::kDim ? pull[0] : turn) - own * own * mass[k]);
  return held;
}

}  // namespace pintle
