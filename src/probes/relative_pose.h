// How frame M (on body B) stands and moves as seen from frame F (on body A): z = (x, y, angle), theory/joints Eqs. (2.1)-(2.8).
// Every planar joint is a selection or a function of z; what a joint does not forbid is what it leaves free.
#pragma once

#include "space/planar.h"

namespace pintle {

/// z and its derivatives. Lengths in F's axes [m], angle of M against F [rad].
///   z' = GA vA + GB vB,   z'' = GA aA + GB aB + bias
struct RelativePose {
  using S = Planar;
  S::Vec z, rate, bias;
  S::Mat GA, GB;      // dz/dqA, dz/dqB
  S::Point arm_a;     // from A's centre of mass to M, world axes [m]
  S::Point arm_b;     // from B's centre of mass to M, world axes [m]
  double c, s;        // F's axes in the world

  static RelativePose between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M);

  /// The force of z-components f (conjugate to z, on B) in world axes [N].
  S::Point world_force(const S::Vec& f) const { return {c * f[0] - s * f[1], s * f[0] + c * f[1]}; }
  /// d(GA' f)/dq and d(GB' f)/dq at constant f: the geometric stiffness, 6 x 6 over (qA, qB), symmetric. Eq. (2.9).
  Eigen::Matrix<double, 6, 6> geometric(const S::Vec& f) const;
  /// d(rate)/dq over (qA, qB), 3 x 6. Eq. (2.10). Needs the motions it was made from.
  Eigen::Matrix<double, 3, 6> rate_gradient(const S::Motion& A, const S::Motion& B) const;
};

inline RelativePose RelativePose::between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M) {
  RelativePose r;
  const S::Point u = A.turned(F.p), w = B.turned(M.p);
  const S::Point d = B.p + w - A.p - u;                                             // p_FM_W
  const S::Point d_rate = B.v - A.v + B.w * S::perp(w) - A.w * S::perp(u);
  r.c = A.c * F.c - A.s * F.s;
  r.s = A.s * F.c + A.c * F.s;
  r.arm_a = u + d;
  r.arm_b = w;
  const auto to_F = [&r](const S::Point& x) { return S::Point(r.c * x.x() + r.s * x.y(), -r.s * x.x() + r.c * x.y()); };
  const S::Point e = to_F(d);                                                       // (2.1)
  const S::Point e_rate = to_F(d_rate - A.w * S::perp(d));                          // (2.2)
  const S::Point e_bias = to_F(-B.w * B.w * w + A.w * A.w * (u - d) - 2 * A.w * S::perp(d_rate));  // (2.3)
  const S::Point turn_a = to_F(-S::perp(r.arm_a)), turn_b = to_F(S::perp(r.arm_b));
  r.z << e.x(), e.y(), B.angle + M.angle - A.angle - F.angle;                       // (2.4)
  r.rate << e_rate.x(), e_rate.y(), B.w - A.w;
  r.bias << e_bias.x(), e_bias.y(), 0;
  r.GA << -r.c, -r.s, turn_a.x(), r.s, -r.c, turn_a.y(), 0, 0, -1;                  // (2.5)
  r.GB << r.c, r.s, turn_b.x(), -r.s, r.c, turn_b.y(), 0, 0, 1;                     // (2.6)
  return r;
}

}  // namespace pintle
