// Geometric stiffness of joints that carry forces, as one on each body alone, whatever its sign. theory/time section 4.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/block.h"
#include "system/system.h"

namespace pintle {

/// How joints hold a body: against moving across them [N/m], against turning by magnitude and with its sign [N*m/rad].
using BodyPull = BlockVec<double, 3>;

/// Of joints whose gap is in the relative pose, at forces f in F's axes. Where a joint holds both components of a point, nothing but
/// the turning of its arms is left of the geometric stiffness, exactly. Along a component that it leaves free the force turns with one
/// body while the other slides. theory/time section 4.1.
template <class Real>
struct PullAcross {
  Real turn_a, turn_b;  // against turning: force times arm
  Real slide;           // the force across a free component
  Real arm_a, arm_b;

  PINTLE_LANES static PullAcross of(const GapMap<Real>& map, const Real& f0, const Real& f1, const Real* forbidden) {
    const Real x = map.c * f0 - map.s * f1, y = map.s * f0 + map.c * f1;
    PullAcross p;
    p.turn_a = -(map.ax * x + map.ay * y);
    p.turn_b = map.bx * x + map.by * y;
    p.slide = size(f1) - forbidden[0] * size(f1) + (size(f0) - forbidden[1] * size(f0));
    p.arm_a = size(map.ax) + size(map.ay);
    p.arm_b = size(map.bx) + size(map.by);
    return p;
  }

 private:
  PINTLE_LANES static double size(double x) { return std::abs(x); }
  template <int N>
  PINTLE_LANES static Lanes<N> size(const Lanes<N>& x) { return sizes(x); }
};

/// A force f across a slide x of a body that turns by theta couples them: f x theta is at most f (x^2 / r + r theta^2) / 2, here with
/// the radius of gyration r.
inline void add_slide(double f, double arm, int body, const System& system, std::vector<BodyPull>& pulled) {
  if (body < 0 || body >= system.n_bodies()) return;
  const double radius = system.bodies[body].radius_of_gyration();
  pulled[body][0] += f / radius;
  pulled[body][1] += f * (radius + arm);
}

/// What joint j does at a force, for one of any kind. Where the gap is a function of the pose, each body takes the sum of the
/// magnitudes in its rows, with turns measured at the radii of gyration (Gershgorin).
void add_pull_of(int j, const System& system, const std::vector<Planar::Motion>& m, const Planar::Vec& force, std::vector<BodyPull>& pulled);

/// What a step does not resolve of it whose own frequency is `own` [1/s]. theory/time Eq. (4.7).
inline Planar::Vec unresolved(const BodyPull& pull, double own, const Planar::Vec& mass) {
  const double across = std::max(0.0, pull[0] - own * own * mass[0]);
  return {across, across, std::max(0.0, pull[1] + std::abs(pull[2]) - own * own * mass[2])};
}

}  // namespace pintle
