// A body and a joint at every stage of a step at once, one stage per lane; and the matrices that mix the stages.
#pragma once

#include "integrators/radau_table.h"
#include "probes/relative_pose.h"
#include "solve/spectrum.h"

namespace pintle {

template <int N>
struct BodyLanes {
  using L = Lanes<N>;
  L q[3], v[3], a[3];
  L c, s;         // cosine and sine of the angle
  L Q[3];         // what is not a joint's force [N, N, N*m]
  L residual[3];  // of its equation of motion [N, N, N*m]

  struct View { const L &x, &y, &c, &s, &vx, &vy, &w; };
  View view() const { return {q[0], q[1], c, s, v[0], v[1], v[2]}; }
  Planar::Motion motion(int i) const { return {{q[0][i], q[1][i]}, q[2][i], c[i], s[i], {v[0][i], v[1][i]}, v[2][i]}; }
};

/// From forces of a gap to forces on bodies, and from accelerations of bodies to that of the gap: G' and G of a pose, times
/// the gradient where the gap is a function of the pose. T is Lanes<N>, or a number where G is frozen.
template <class T>
struct GapMap {
  T c, s, ax, ay, bx, by;  // as in PoseGeometry
  T gradient[3];           // of a gap that is a function
  bool function = false;

  void take(const PoseGeometry<T>& pose) {
    c = pose.c;
    s = pose.s;
    ax = pose.ax;
    ay = pose.ay;
    bx = pose.bx;
    by = pose.by;
  }
  /// The map of one lane.
  GapMap<double> lane(int i) const {
    return {c[i], s[i], ax[i], ay[i], bx[i], by[i], {gradient[0][i], gradient[1][i], gradient[2][i]}, function};
  }

  template <class U>
  struct OnBodies { U fx, fy, ma, mb; };  // force on B (on A the opposite), moments on A and B

  /// G' f.
  template <class U>
  OnBodies<U> spread(const U* f) const {
    const U f0 = function ? gradient[0] * f[0] : f[0], f1 = function ? gradient[1] * f[0] : f[1],
            f2 = function ? gradient[2] * f[0] : f[2];
    OnBodies<U> r;
    r.fx = c * f0 - s * f1;
    r.fy = s * f0 + c * f1;
    r.ma = ay * r.fx - ax * r.fy - f2;
    r.mb = bx * r.fy - by * r.fx + f2;
    return r;
  }
  /// G a.
  template <class U>
  void gather(const U* on_a, const U* on_b, U* e) const {
    const U x = on_b[0] - on_a[0] + ay * on_a[2] - by * on_b[2], y = on_b[1] - on_a[1] + bx * on_b[2] - ax * on_a[2];
    e[0] = c * x + s * y;
    e[1] = c * y - s * x;
    e[2] = on_b[2] - on_a[2];
    if (!function) return;
    e[0] = gradient[0] * e[0] + gradient[1] * e[1] + gradient[2] * e[2];
    e[1] = e[2] = U();
  }
};

template <int N>
struct JointLanes {
  using L = Lanes<N>;
  L gap[3], rate[3], accel[3], force[3];
  L target_accel;         // of a servo's target
  L residual[3];          // of the gap's acceleration [m/s^2, m/s^2, rad/s^2]
  GapMap<L> map;
  GapMap<double> frozen;  // at the stage where the equations are linearised
  Planar::Vec frozen_force;                                                // there
  Planar::Mat K = Planar::Mat::Zero(), C = Planar::Mat::Zero();  // the law's tangents there
  bool diagonal = false;  // they are
  Spectrum<N> weight[9];  // (K + mu C) / mu^2; the first three when diagonal
  Spectrum<N> e[3];       // the residual in the diagonal frame
};

/// The table as it acts on lanes: stages to stages, and to and from the diagonal frame.
template <int N>
struct StageMatrices {
  Lanes<N> c;                    // stage times
  LaneMatrix<N> A, A2, T, T_inverse;
  Spectrum<N> eigenvalue;

  explicit StageMatrices(const RadauTable& table) {
    for (int i = 0; i < N; ++i) {
      c.set(i, table.c[i]);
      for (int k = 0; k < N; ++k) {
        A.column[k].set(i, table.A(i, k));
        A2.column[k].set(i, table.A2(i, k));
      }
    }
    for (int p = 0; p < N / 2; ++p) {
      eigenvalue.x.set(2 * p, table.eigenvalue[p].real());
      eigenvalue.x.set(2 * p + 1, table.eigenvalue[p].imag());
      for (int i = 0; i < N; ++i) {
        T.column[2 * p].set(i, 2 * table.T_complex[p][i].real());
        T.column[2 * p + 1].set(i, -2 * table.T_complex[p][i].imag());
        T_inverse.column[i].set(2 * p, table.inverse_complex[p][i].real());
        T_inverse.column[i].set(2 * p + 1, table.inverse_complex[p][i].imag());
      }
    }
    eigenvalue.x.set(N - 1, table.real_eigenvalue);
    for (int i = 0; i < N; ++i) {
      T.column[N - 1].set(i, table.T_real[i]);
      T_inverse.column[i].set(N - 1, table.inverse_real[i]);
    }
  }
};

}  // namespace pintle
