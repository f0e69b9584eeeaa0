// A gap's Jacobians in factored form: the rotation into F's axes, and the arms of the point where the joint acts.
#pragma once

#include "simd/lanes.h"
#include "space/planar_pose.h"

namespace pintle {

/// From forces of a gap to forces on bodies, and from accelerations of bodies to that of the gap: G' and G of a pose, times
/// the gradients where components of the gap are functions of the pose. T is a number, or one number per stage of a step.
template <class T>
struct PlanarGapMap {
  static constexpr int kMostFunctions = 3;
  T c, s, ax, ay, bx, by;         // as in PlanarPoseGeometry
  T gradient[kMostFunctions][3];  // of the first components, if they are functions
  int functions = 0;              // number of functions; if there are any, there are no other components

  void set(const PlanarPoseGeometry<T>& pose) {
    c = pose.c;
    s = pose.s;
    ax = pose.ax;
    ay = pose.ay;
    bx = pose.bx;
    by = pose.by;
  }
  static PlanarGapMap of(const PlanarRelativePose& pose) {
    return {pose.c, pose.s, pose.arm_a.x(), pose.arm_a.y(), pose.arm_b.x(), pose.arm_b.y(), {}, 0};
  }
  /// The same map in every lane.
  static PlanarGapMap same(const PlanarGapMap<double>& g) {
    PlanarGapMap map{T(g.c), T(g.s), T(g.ax), T(g.ay), T(g.bx), T(g.by), {}, g.functions};
    for (int f = 0; f < g.functions; ++f)
      for (int k = 0; k < 3; ++k) map.gradient[f][k] = T(g.gradient[f][k]);
    return map;
  }
  /// The map of one lane.
  PlanarGapMap<double> lane(int i) const {
    PlanarGapMap<double> map{c[i], s[i], ax[i], ay[i], bx[i], by[i], {}, functions};
    for (int f = 0; f < functions; ++f)
      for (int k = 0; k < 3; ++k) map.gradient[f][k] = gradient[f][k][i];
    return map;
  }

  /// G of the first and of the second body, 3 x 3.
  Planar::Mat GA() const { return rows(-c, -s, c * ay - s * ax, s, -c, -s * ay - c * ax, -1); }
  Planar::Mat GB() const { return rows(c, s, s * bx - c * by, -s, c, c * bx + s * by, 1); }

  template <class U>
  struct OnBodies { U fx, fy, ma, mb; };  // force on B (opposite on A), moments on A and B

  /// G' f.
  template <class U>
  OnBodies<U> spread(const U* f) const {
    U f0 = functions > 0 ? gradient[0][0] * f[0] : f[0], f1 = functions > 0 ? gradient[0][1] * f[0] : f[1],
      f2 = functions > 0 ? gradient[0][2] * f[0] : f[2];
    for (int k = 1; k < functions; ++k) {
      f0 += gradient[k][0] * f[k];
      f1 += gradient[k][1] * f[k];
      f2 += gradient[k][2] * f[k];
    }
    OnBodies<U> r;
    r.fx = c * f0 - s * f1;
    r.fy = s * f0 + c * f1;
    r.ma = ay * r.fx - ax * r.fy - f2;
    r.mb = bx * r.fy - by * r.fx + f2;
    return r;
  }
  /// on_a, on_b += G' f: forces and moment of both bodies.
  template <class U, class V>
  void push(const U* f, V& on_a, V& on_b) const {
    const OnBodies<U> on = spread(f);
    on_a[0] -= on.fx;
    on_a[1] -= on.fy;
    on_a[2] += on.ma;
    on_b[0] += on.fx;
    on_b[1] += on.fy;
    on_b[2] += on.mb;
  }
  /// on_a, on_b = G' f.
  template <class U>
  void wrenches(const U* f, U* on_a, U* on_b) const {
    const OnBodies<U> on = spread(f);
    on_a[0] = -on.fx;
    on_a[1] = -on.fy;
    on_a[2] = on.ma;
    on_b[0] = on.fx;
    on_b[1] = on.fy;
    on_b[2] = on.mb;
  }
  /// on_a, on_b += the magnitudes of the same forces and moments.
  template <class U, class V>
  void push_magnitudes(const U* f, V& on_a, V& on_b) const {
    const OnBodies<U> on = spread(f);
    const U x = size(on.fx), y = size(on.fy);
    on_a[0] += x;
    on_a[1] += y;
    on_a[2] += size(on.ma);
    on_b[0] += x;
    on_b[1] += y;
    on_b[2] += size(on.mb);
  }
  /// G a.
  template <class U>
  void gather(const U* on_a, const U* on_b, U* e) const {
    const U x = on_b[0] - on_a[0] + ay * on_a[2] - by * on_b[2], y = on_b[1] - on_a[1] + bx * on_b[2] - ax * on_a[2];
    e[0] = c * x + s * y;
    e[1] = c * y - s * x;
    e[2] = on_b[2] - on_a[2];
    if (functions == 0) return;
    const U first = along(0, e), second = functions > 1 ? along(1, e) : U(), third = functions > 2 ? along(2, e) : U();
    e[0] = first;
    e[1] = second;
    e[2] = third;
  }

 private:
  // Change of a function along a change e of the pose.
  template <class U>
  U along(int f, const U* e) const { return gradient[f][0] * e[0] + gradient[f][1] * e[1] + gradient[f][2] * e[2]; }
  static double size(double x) { return std::abs(x); }
  template <int N>
  static Lanes<N> size(const Lanes<N>& x) { return sizes(x); }
  // joints (2.5), (2.6), and the chain rule.
  Planar::Mat rows(T xx, T xy, T xt, T yx, T yy, T yt, T tt) const {
    Planar::Mat G;
    G << xx, xy, xt, yx, yy, yt, 0, 0, tt;
    if (functions == 0) return G;
    Planar::Mat of_functions = Planar::Mat::Zero();
    for (int f = 0; f < functions; ++f) of_functions.row(f) = gradient[f][0] * G.row(0) + gradient[f][1] * G.row(1) + gradient[f][2] * G.row(2);
    return of_functions;
  }
};

}  // namespace pintle
