// Position and motion of frame M (on body B) relative to frame F (on body A): z = (x, y, angle), theory/joints Eqs.
// (2.1)-(2.8). Every planar joint is a selection or a function of z; the components that a joint does not forbid are free.
#pragma once

#include "space/planar.h"

namespace pintle {

/// The quantities from which z, z' and z'' are formed, in world axes unless stated otherwise; T is a number, or one number per stage of a step.
template <class T>
struct PlanarPoseGeometry {
  T c, s;            // F's axes in the world
  T dx, dy;          // from F to M [m]
  T rx, ry;          // its rate [m/s]
  T ax, ay, bx, by;  // arms: from A's, from B's centre of mass to M [m]
  T bias_x, bias_y;  // convective acceleration, in F's axes [m/s^2]

  /// A and B: any type with x, y, its sine s and cosine c, and rates vx, vy, w. F and M: frames as in Planar, of numbers or lanes.
  template <class Body, class Frame>
  static PlanarPoseGeometry between(const Body& A, const Frame& F, const Body& B, const Frame& M);
  /// z, for bodies and frames that have their angles. Eqs. (2.1), (2.4).
  template <class Body, class Frame, class Gap>
  void gaps(const Body& A, const Frame& F, const Body& B, const Frame& M, Gap& z) const {
    z[0] = c * dx + s * dy;
    z[1] = c * dy - s * dx;
    z[2] = B.angle + M.angle - A.angle - F.angle;
  }
  /// z'. Eq. (2.2).
  template <class Body, class Gap>
  void rates(const Body& A, const Body& B, Gap& rate) const {
    const T x = rx + A.w * dy, y = ry - A.w * dx;
    rate[0] = c * x + s * y;
    rate[1] = c * y - s * x;
    rate[2] = B.w - A.w;
  }
  /// The convective part of z''. Eq. (2.3).
  template <class Gap>
  void biases(Gap& bias) const {
    bias[0] = bias_x;
    bias[1] = bias_y;
    bias[2] = T(0.0);
  }
};

/// z and its derivatives. Lengths in F's axes [m], angle of M against F [rad].
///   z' = GA vA + GB vB,   z'' = GA aA + GB aB + bias   with GA = dz/dqA and GB = dz/dqB
struct PlanarRelativePose {
  using S = Planar;
  S::Vec z, rate, bias;
  S::Point arm_a;     // from A's centre of mass to M, world axes [m]
  S::Point arm_b;     // from B's centre of mass to M, world axes [m]
  double c, s;        // F's axes in the world

  S::Mat GA() const;  // dz/dqA
  S::Mat GB() const;  // dz/dqB

  static PlanarRelativePose between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M);

  /// The force in world axes [N] of z-components f (conjugate to z, on B).
  S::Point world_force(const S::Vec& f) const { return {c * f[0] - s * f[1], s * f[0] + c * f[1]}; }
  /// Its couple on B about M's origin [N*m].
  double world_couple(const S::Vec& f) const { return f[2]; }
  /// d(GA' f)/dq and d(GB' f)/dq at constant f: the geometric stiffness, 6 x 6 over (qA, qB), symmetric. Eq. (2.9).
  Eigen::Matrix<double, 6, 6> geometric(const S::Vec& f) const;
  /// d(rate)/dq over (qA, qB), 3 x 6. Eq. (2.10). Takes the motions from which the pose was made.
  Eigen::Matrix<double, 3, 6> rate_gradient(const S::Motion& A, const S::Motion& B) const;
  /// d(bias)/dq over (qA, qB) at constant velocities, 3 x 6. Eq. (2.22). Takes the motions from which the pose was made.
  Eigen::Matrix<double, 3, 6> bias_gradient(const S::Motion& A, const S::Motion& B) const;
};

template <class T>
template <class Body, class Frame>
inline PlanarPoseGeometry<T> PlanarPoseGeometry<T>::between(const Body& A, const Frame& F, const Body& B, const Frame& M) {
  PlanarPoseGeometry g;
  const T ux = A.c * F.p.x() - A.s * F.p.y(), uy = A.s * F.p.x() + A.c * F.p.y();
  g.bx = B.c * M.p.x() - B.s * M.p.y();
  g.by = B.s * M.p.x() + B.c * M.p.y();
  g.dx = B.x + g.bx - A.x - ux;                                                     // p_FM_W
  g.dy = B.y + g.by - A.y - uy;
  g.rx = B.vx - A.vx - B.w * g.by + A.w * uy;
  g.ry = B.vy - A.vy + B.w * g.bx - A.w * ux;
  g.ax = ux + g.dx;
  g.ay = uy + g.dy;
  g.c = A.c * F.c - A.s * F.s;
  g.s = A.s * F.c + A.c * F.s;
  const T wa2 = A.w * A.w, wb2 = B.w * B.w, wa = 2 * A.w;
  const T x = wa2 * (ux - g.dx) - wb2 * g.bx + wa * g.ry, y = wa2 * (uy - g.dy) - wb2 * g.by - wa * g.rx;
  g.bias_x = g.c * x + g.s * y;                                                     // (2.3)
  g.bias_y = g.c * y - g.s * x;
  return g;
}

inline PlanarRelativePose PlanarRelativePose::between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M) {
  struct View {
    double x, y, angle, c, s, vx, vy, w;
    explicit View(const S::Motion& m) : x(m.p.x()), y(m.p.y()), angle(m.angle), c(m.c), s(m.s), vx(m.v.x()), vy(m.v.y()), w(m.w) {}
  };
  const View a(A), b(B);
  const auto g = PlanarPoseGeometry<double>::between(a, F, b, M);
  PlanarRelativePose r;
  r.c = g.c;
  r.s = g.s;
  r.arm_a = {g.ax, g.ay};
  r.arm_b = {g.bx, g.by};
  g.gaps(a, F, b, M, r.z);
  g.rates(a, b, r.rate);
  g.biases(r.bias);
  return r;
}

}  // namespace pintle
