// Positions of a body in space at all stages of a step at once, one stage per lane. Orientations are given by the rotation vector
// from the start of the step, whose rates are collocated with the angular velocities. theory/space section 2.
#pragma once

#include <limits>

#include "space/spatial_pose.h"

namespace pintle {

template <int N>
struct SpatialBodyLanes {
  using L = Lanes<N>;
  using S = Spatial;
  L q[3], v[6], a[6];           // position; velocities and accelerations as in Spatial::Vec
  Vector3<L> turn, turn_rate;   // rotation vector from the start, in body axes, and its rate
  Matrix3<L> R;                 // body axes in the world
  Vector3<L> w;                 // angular velocity in world axes
  L change;                     // of the rotation vector in the last sweep

  SpatialBodyView<L> view() const { return {{q[0], q[1], q[2]}, R, {v[0], v[1], v[2]}, w}; }
  S::Motion motion(int i) const {
    S::Motion m;
    m.p = {q[0][i], q[1][i], q[2][i]};
    m.R << R.xx[i], R.xy[i], R.xz[i], R.yx[i], R.yy[i], R.yz[i], R.zx[i], R.zy[i], R.zz[i];
    m.v = {v[0][i], v[1][i], v[2][i]};
    m.w_body = {v[3][i], v[4][i], v[5][i]};
    m.w = {w.x[i], w.y[i], w.z[i]};
    return m;
  }
  S::Coordinates coordinates(int i, const S::Coordinates& q0) const {
    return {{q[0][i], q[1][i], q[2][i]}, (q0.r * rotation::quaternion({turn.x[i], turn.y[i], turn.z[i]})).normalized()};
  }

  /// The rate of the increment from the step's start.
  void write_increment_rate(int i, S::Vec& rate) const { rate << v[0][i], v[1][i], v[2][i], turn_rate.x[i], turn_rate.y[i], turn_rate.z[i]; }

  void stand_still() {
    for (L& x : q) x = L::all(0);
    for (L& x : v) x = L::all(0);
    for (L& x : a) x = L::all(0);
    turn = turn_rate = w = {L::all(0), L::all(0), L::all(0)};
    R = identity3<L>();
    change = L::all(0);
  }

  /// Positions and velocities from accelerations, by the step's matrices. Eqs. (2.1), (2.2).
  template <class Step>
  PINTLE_LANES void place(const Step& step, const S::Coordinates& q0, const S::Vec& v0) {
    for (int k = 0; k < 3; ++k) q[k] = step.place(a[k], q0.p[k], v0[k], v[k]);
    for (int k = 3; k < 6; ++k) v[k] = L::all(v0[k]) + step.A * a[k];
    sweep(step);
    orient(q0.r);
  }
  /// The first call in a step: the rotation vectors are initialised with the integrals of the angular velocities.
  template <class Step>
  PINTLE_LANES void begin(const Step& step, const S::Coordinates& q0, const S::Vec& v0) {
    L rates;
    turn = {step.place(a[3], 0, v0[3], rates), step.place(a[4], 0, v0[4], rates), step.place(a[5], 0, v0[5], rates)};
    place(step, q0, v0);
  }
  /// Lanes of numbers or infinities.
  PINTLE_LANES const L& to_check() const { return change; }
  PINTLE_LANES static bool must_check(const L&) { return false; }
  PINTLE_LANES void check() {}
  /// To be called after velocities have been changed.
  PINTLE_LANES void renew_rates() { w = R * Vector3<L>{v[3], v[4], v[5]}; }

  /// Moves the body from q0 by increments.
  PINTLE_LANES void displace(const S::Coordinates& q0, const L (&dq)[6]) {
    for (int k = 0; k < 3; ++k) q[k] = L::all(q0.p[k]) + dq[k];
    turn = {dq[3], dq[4], dq[5]};
    orient(q0.r);
  }
  /// Moves the body on by increments, without counting them in `turn`.
  PINTLE_LANES void move(const L* dq) {
    for (int k = 0; k < 3; ++k) q[k] += dq[k];
    const Vector3<L> on{dq[3], dq[4], dq[5]};
    R = R * rotation::matrix(on, rotation::functions(rotation::square_of(on)));
    renew_rates();
  }
  /// R and w from `turn` and the angular velocity.
  PINTLE_LANES void orient(const Eigen::Quaterniond& r0) {
    const Matrix3<double> start = components(Eigen::Matrix3d(r0.toRotationMatrix()));
    R = start * rotation::matrix(turn, rotation::functions(rotation::square_of(turn)));
    w = R * Vector3<L>{v[3], v[4], v[5]};
  }

 private:
  static constexpr int kMostSweeps = 12;
  static constexpr double kConverged = 1e-14;      // [rad]
  static constexpr double kMostTurn = 4.5;         // [rad]: at 2 pi the rotation vector is singular

  // Solves Eq. (2.2) by fixed-point iteration, from the current rotation vector.
  template <class Step>
  PINTLE_LANES void sweep(const Step& step) {
    const Vector3<L> spin{v[3], v[4], v[5]};
    for (int i = 0; i < kMostSweeps; ++i) {
      turn_rate = rotation::rate(turn, spin, rotation::functions(rotation::square_of(turn)).inverse);
      const Vector3<L> next{step.A * turn_rate.x, step.A * turn_rate.y, step.A * turn_rate.z};
      change = larger_size(larger_size(sizes(next.x - turn.x), next.y - turn.y), next.z - turn.z);
      turn = next;
      bool settled = true;
      for (int s = 0; s < N; ++s) settled = settled && change[s] < kConverged;
      if (settled) break;
    }
    const L square = rotation::square_of(turn);
    for (int s = 0; s < N; ++s)
      if (!(square[s] < kMostTurn * kMostTurn)) v[3].set(s, std::numeric_limits<double>::quiet_NaN());
  }
};

}  // namespace pintle
