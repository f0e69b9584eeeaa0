// Positions of a planar body at all stages of a step at once, one stage per lane.
#pragma once

#include "simd/lanes.h"
#include "space/planar.h"

namespace pintle {

template <int N>
struct PlanarBodyLanes {
  using L = Lanes<N>;
  using S = Planar;
  L q[3], v[3], a[3];
  L c, s;         // cosine and sine of the angle

  struct View { const L &x, &y, &c, &s, &vx, &vy, &w, &angle; };
  View view() const { return {q[0], q[1], c, s, v[0], v[1], v[2], q[2]}; }
  S::Motion motion(int i) const { return {{q[0][i], q[1][i]}, q[2][i], c[i], s[i], {v[0][i], v[1][i]}, v[2][i]}; }
  S::Coordinates coordinates(int i, const S::Coordinates&) const { return {q[0][i], q[1][i], q[2][i]}; }

  void stand_still() { c = L::all(1); }
  /// Positions and velocities from accelerations, by the step's matrices. theory/time Eq. (3.5).
  template <class Step>
  PINTLE_LANES void place(const Step& step, const S::Coordinates& q0, const S::Vec& v0) {
    for (int k = 0; k < 3; ++k) q[k] = step.place(a[k], q0[k], v0[k], v[k]);
    sine_and_cosine_unchecked(q[2], s, c);
  }
  /// The first call in a step.
  template <class Step>
  PINTLE_LANES void begin(const Step& step, const S::Coordinates& q0, const S::Vec& v0) { place(step, q0, v0); }
  /// What must be checked for all bodies together: angles.
  PINTLE_LANES const L& to_check() const { return q[2]; }
  PINTLE_LANES static bool must_check(const L& largest) { return any_beyond_largest_angle(largest); }
  PINTLE_LANES void check() { sine_and_cosine(q[2], s, c); }
  /// To be called after velocities have been changed.
  PINTLE_LANES void renew_rates() {}
  /// Moves the body on by increments.
  PINTLE_LANES void move(const L* dq) {
    for (int k = 0; k < 3; ++k) q[k] += dq[k];
    check();
  }
};

}  // namespace pintle
