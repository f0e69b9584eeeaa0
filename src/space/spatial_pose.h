// Position and motion of frame M (on body B) relative to frame F (on body A), in space: theory/space section 3. The relative pose z has
// six components: the position of M's origin in F's axes; the tilts of M's z axis about F's x and y axes, by their sines; and the turn
// about the z axis, the sum of the turns before and after the tilt. Joints are selections from them or functions of them.
#pragma once

#include "space/spatial.h"

namespace pintle {

template <class T>
struct SpatialBodyView {
  Vector3<T> p;   // centre of mass, world axes
  Matrix3<T> R;   // body axes in the world
  Vector3<T> v;   // its velocity, world axes
  Vector3<T> w;   // angular velocity, world axes
};

namespace rotation {
/// 1 / (1 + n), n the cosine of a tilt, but finite also at half a turn, where the turn about the axis is undefined: a joint that leaves
/// both free has no force there for it to multiply. theory/space Eq. (3.4) and section 3.6.
inline constexpr double kLeastOnePlusCosine = 1e-12;
inline double over_one_plus(double n) { return 1 / std::max(1 + n, kLeastOnePlusCosine); }
template <int N>
PINTLE_LANES Lanes<N> over_one_plus(const Lanes<N>& n) {
  return reciprocal(larger(Lanes<N>(1.0) + n, Lanes<N>(kLeastOnePlusCosine)));
}
}  // namespace rotation

/// J w in components 3 to 5 of `rate`: the rates of the tilts and of the turn at the relative angular velocity w. n is M's z axis, k = 1 / (1 + n_z); n
/// and w are in F's axes. theory/space Eq. (3.4).
template <class T, class U, class Rate>
PINTLE_LANES void put_turning(const Vector3<T>& n, const T& k, const Vector3<U>& w, Rate&& rate) {
  rate[3] = n.z * w.x - n.x * w.z;
  rate[4] = n.z * w.y - n.y * w.z;
  rate[5] = k * (n.x * w.x + n.y * w.y) + w.z;
}
/// J' (tilt_x, tilt_y, turn): the couple, in F's axes, of moments conjugate to the tilts and the turn.
template <class T, class U>
PINTLE_LANES Vector3<U> couple_of(const Vector3<T>& n, const T& k, const U& tilt_x, const U& tilt_y, const U& turn) {
  return {n.z * tilt_x + (k * n.x) * turn, n.z * tilt_y + (k * n.y) * turn, turn - (n.x * tilt_x + n.y * tilt_y)};
}

/// The quantities from which z, z' and z'' are formed; T is a number, or one number per stage of a step.
template <class T>
struct SpatialPoseGeometry {
  Matrix3<T> RA, RB, RF;      // axes of the bodies and of F in the world
  Matrix3<T> R;               // axes of M in F's
  Vector3<T> d;               // from F to M, world axes [m]
  Vector3<T> arm_a, arm_b;    // from A's, from B's centre of mass to M, world axes [m]
  Vector3<T> dd;              // rate of d minus the part due to F's rotation, world axes [m/s]
  Vector3<T> w, wa;           // relative angular velocity and that of A, F's axes [rad/s]
  Vector3<T> bias;            // convective acceleration of M's origin, F's axes [m/s^2]

  template <class Frame>
  PINTLE_LANES static SpatialPoseGeometry between(const SpatialBodyView<T>& A, const Frame& F, const SpatialBodyView<T>& B, const Frame& M) {
    SpatialPoseGeometry g;
    g.RA = A.R;
    g.RB = B.R;
    g.RF = A.R * F.R;
    const Matrix3<T> RM = B.R * M.R;
    const auto x = turned_back(g.RF, Vector3<T>{RM.xx, RM.yx, RM.zx}), y = turned_back(g.RF, Vector3<T>{RM.xy, RM.yy, RM.zy}), z = turned_back(g.RF, Vector3<T>{RM.xz, RM.yz, RM.zz});
    g.R = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
    const Vector3<T> u = A.R * F.p;
    g.arm_b = B.R * M.p;
    g.d = (B.p + g.arm_b) - (A.p + u);                                                  // (3.1)
    g.arm_a = u + g.d;
    const Vector3<T> spin_b = cross(B.w, g.arm_b), spin_a = cross(A.w, u);
    const Vector3<T> rate = (B.v + spin_b) - (A.v + spin_a);
    g.dd = rate - cross(A.w, g.d);                                                      // (3.3)
    g.w = turned_back(g.RF, B.w - A.w);
    g.wa = turned_back(g.RF, A.w);
    g.bias = turned_back(g.RF, cross(B.w, spin_b) - cross(A.w, spin_a) - cross(A.w, rate + g.dd));  // (3.5)
    return g;
  }

  /// z. Eqs. (3.1), (3.2).
  template <class Body, class Frame, class Gap>
  void gaps(const Body&, const Frame&, const Body&, const Frame&, Gap& z) const {
    const Vector3<T> at = turned_back(RF, d);
    z[0] = at.x;
    z[1] = at.y;
    z[2] = at.z;
    z[3] = -R.yz;
    z[4] = R.xz;
    z[5] = twist(R.yx - R.xy, R.xx + R.yy);
  }
  /// z'. Eqs. (3.3), (3.4).
  template <class Body, class Gap>
  PINTLE_LANES void rates(const Body&, const Body&, Gap& rate) const {
    const Vector3<T> at = turned_back(RF, dd);
    rate[0] = at.x;
    rate[1] = at.y;
    rate[2] = at.z;
    put_turning(Vector3<T>{R.xz, R.yz, R.zz}, rotation::over_one_plus(R.zz), w, rate);
  }
  /// The convective part of z''. Eqs. (3.5), (3.6).
  template <class Gap>
  PINTLE_LANES void biases(Gap& out) const {
    const Vector3<T> n{R.xz, R.yz, R.zz}, dn = cross(w, n), turning = cross(w, wa);
    const T k = rotation::over_one_plus(n.z), kx = k * n.x, ky = k * n.y;
    out[0] = bias.x;
    out[1] = bias.y;
    out[2] = bias.z;
    out[3] = n.z * turning.x - n.x * turning.z + (dn.z * w.x - dn.x * w.z);
    out[4] = n.z * turning.y - n.y * turning.z + (dn.z * w.y - dn.y * w.z);
    out[5] = kx * turning.x + ky * turning.y + turning.z + k * ((dn.x - kx * dn.z) * w.x + (dn.y - ky * dn.z) * w.y);
  }

 private:
  static double twist(double sine, double cosine) { return std::atan2(sine, cosine); }
  template <int N>
  static Lanes<N> twist(const Lanes<N>& sine, const Lanes<N>& cosine) {
    Lanes<N> angle;
    for (int i = 0; i < N; ++i) angle.set(i, std::atan2(sine[i], cosine[i]));
    return angle;
  }
};

/// From forces of a gap to forces on bodies, and from accelerations of bodies to that of the gap: G' and G of a pose, times the gradient
/// if the gap is a function of the pose. Moments and angular accelerations are in the axes of each body. Eqs. (3.7), (3.8).
template <class T>
struct SpatialGapMap {
  Matrix3<T> RA, RB, RF;
  Vector3<T> arm_a, arm_b, n;  // n: M's z axis in F's axes
  T k;                         // 1 / (1 + n_z)
  static constexpr int kMostFunctions = 1;
  T gradient[kMostFunctions][6];  // of the first component, if it is a function
  int functions = 0;              // 1 if so; there are no other components then

  PINTLE_LANES void set(const SpatialPoseGeometry<T>& pose) {
    RA = pose.RA;
    RB = pose.RB;
    RF = pose.RF;
    arm_a = pose.arm_a;
    arm_b = pose.arm_b;
    n = {pose.R.xz, pose.R.yz, pose.R.zz};
    k = rotation::over_one_plus(n.z);
  }
  static SpatialGapMap of(const SpatialPoseGeometry<T>& pose) {
    SpatialGapMap map;
    map.set(pose);
    for (T& g : map.gradient[0]) g = T(0.0);
    return map;
  }
  static SpatialGapMap of(const SpatialRelativePose& pose);

  /// The same map in every lane.
  static SpatialGapMap same(const SpatialGapMap<double>& g) {
    SpatialGapMap map;
    map.each(g, [](T& to, double from) { to = T(from); });
    map.functions = g.functions;
    return map;
  }
  /// The map of one lane.
  SpatialGapMap<double> lane(int i) const {
    SpatialGapMap<double> map;
    map.each(*this, [i](double& to, const T& from) { to = from[i]; });
    map.functions = functions;
    return map;
  }
  template <class Other, class Put>
  void each(const Other& from, Put&& put) {
    put_matrix(RA, from.RA, put);
    put_matrix(RB, from.RB, put);
    put_matrix(RF, from.RF, put);
    put_vector(arm_a, from.arm_a, put);
    put_vector(arm_b, from.arm_b, put);
    put_vector(n, from.n, put);
    put(k, from.k);
    for (int i = 0; i < 6; ++i) put(gradient[0][i], from.gradient[0][i]);
  }

  /// G of the first and of the second body, 6 x 6.
  Spatial::Mat GA() const { return columns(0); }
  Spatial::Mat GB() const { return columns(1); }

  /// on_a, on_b += G' f: forces and moments of both bodies.
  template <class U, class V>
  PINTLE_LANES void push(const U* f, V& on_a, V& on_b) const {
    const Wrenches<U> on = spread(f);
    add(Vector3<U>{-on.force.x, -on.force.y, -on.force.z}, Vector3<U>{-on.on_a.x, -on.on_a.y, -on.on_a.z}, on_a);
    add(on.force, on.on_b, on_b);
  }
  /// on_a, on_b = G' f.
  template <class U>
  PINTLE_LANES void wrenches(const U* f, U* on_a, U* on_b) const {
    for (int i = 0; i < 6; ++i) on_a[i] = on_b[i] = U(0.0);
    push(f, on_a, on_b);
  }
  /// on_a, on_b += the magnitudes of the same forces and moments.
  template <class U, class V>
  PINTLE_LANES void push_magnitudes(const U* f, V& on_a, V& on_b) const {
    const Wrenches<U> on = spread(f);
    const Vector3<U> force{size(on.force.x), size(on.force.y), size(on.force.z)};
    add(force, Vector3<U>{size(on.on_a.x), size(on.on_a.y), size(on.on_a.z)}, on_a);
    add(force, Vector3<U>{size(on.on_b.x), size(on.on_b.y), size(on.on_b.z)}, on_b);
  }
  /// G a.
  template <class U>
  PINTLE_LANES void gather(const U* on_a, const U* on_b, U* e) const {
    const Vector3<U> wa = RA * Vector3<U>{on_a[3], on_a[4], on_a[5]}, wb = RB * Vector3<U>{on_b[3], on_b[4], on_b[5]};
    const Vector3<U> va{on_a[0], on_a[1], on_a[2]}, vb{on_b[0], on_b[1], on_b[2]};
    const Vector3<U> v = turned_back(RF, (vb + cross_back(arm_b, wb)) - (va + cross_back(arm_a, wa))), w = turned_back(RF, wb - wa);
    e[0] = v.x;
    e[1] = v.y;
    e[2] = v.z;
    put_turning(n, k, w, e);
    if (functions == 0) return;
    const T* g = gradient[0];
    e[0] = g[0] * e[0] + g[1] * e[1] + g[2] * e[2] + g[3] * e[3] + g[4] * e[4] + g[5] * e[5];
    for (int i = 1; i < 6; ++i) e[i] = U(0.0);
  }

 private:
  template <class U>
  struct Wrenches { Vector3<U> force, on_a, on_b; };  // force on B, moments on A (reversed) and on B, each in its body's axes

  template <class U>
  PINTLE_LANES Wrenches<U> spread(const U* f) const {
    const auto part = [&](int i) { return functions > 0 ? gradient[0][i] * f[0] : f[i]; };
    const Vector3<U> force = RF * Vector3<U>{part(0), part(1), part(2)};
    const Vector3<U> couple = RF * couple_of(n, k, U(part(3)), U(part(4)), U(part(5)));
    return {force, turned_back(RA, cross(arm_a, force) + couple), turned_back(RB, cross(arm_b, force) + couple)};
  }
  template <class U, class V>
  PINTLE_LANES static void add(const Vector3<U>& force, const Vector3<U>& moment, V& on) {
    on[0] += force.x;
    on[1] += force.y;
    on[2] += force.z;
    on[3] += moment.x;
    on[4] += moment.y;
    on[5] += moment.z;
  }
  // w x arm, where the arm has another number type.
  template <class U>
  PINTLE_LANES static Vector3<U> cross_back(const Vector3<T>& arm, const Vector3<U>& w) {
    return {arm.z * w.y - arm.y * w.z, arm.x * w.z - arm.z * w.x, arm.y * w.x - arm.x * w.y};
  }
  static double size(double x) { return std::abs(x); }
  template <int N>
  PINTLE_LANES static Lanes<N> size(const Lanes<N>& x) { return sizes(x); }

  Spatial::Mat columns(int body) const {
    Spatial::Mat G;
    for (int c = 0; c < 6; ++c) {
      double x[2][6] = {};
      x[body][c] = 1;
      gather(x[0], x[1], G.col(c).data());
    }
    return G;
  }

  template <class A, class B, class Put>
  static void put_vector(Vector3<A>& to, const Vector3<B>& from, Put& put) {
    put(to.x, from.x);
    put(to.y, from.y);
    put(to.z, from.z);
  }
  template <class A, class B, class Put>
  static void put_matrix(Matrix3<A>& to, const Matrix3<B>& from, Put& put) {
    put(to.xx, from.xx), put(to.xy, from.xy), put(to.xz, from.xz);
    put(to.yx, from.yx), put(to.yy, from.yy), put(to.yz, from.yz);
    put(to.zx, from.zx), put(to.zy, from.zy), put(to.zz, from.zz);
  }
};

/// The force in world axes [N] of z-components f (conjugate to z, on B), and their couple about M's origin [N*m].
Spatial::Point world_force(const SpatialGapMap<double>& map, const Spatial::Vec& f);
Spatial::Point world_couple(const SpatialGapMap<double>& map, const Spatial::Vec& f);
/// d(GA' f)/dq and d(GB' f)/dq at constant f: the geometric stiffness, 12 x 12 over (qA, qB), in the bodies' axes. Eqs. (3.9)-(3.11).
Eigen::Matrix<double, 12, 12> geometric_stiffness(const SpatialGapMap<double>& map, const Spatial::Vec& f);

/// z and its derivatives. Lengths in F's axes [m], tilts [-], turn [rad].
///   z' = GA vA + GB vB,   z'' = GA aA + GB aB + bias   with GA = dz/dqA and GB = dz/dqB, by increments in the bodies' axes
struct SpatialRelativePose {
  using S = Spatial;
  S::Vec z, rate, bias;
  SpatialGapMap<double> map;
  SpatialBodyView<double> A, B;        // from which it was made
  SpatialFrame<double> F, M;

  S::Mat GA() const { return map.GA(); }
  S::Mat GB() const { return map.GB(); }

  static SpatialRelativePose between(const S::Motion& A, const S::Frame& F, const S::Motion& B, const S::Frame& M);

  S::Point world_force(const S::Vec& f) const;
  S::Point world_couple(const S::Vec& f) const;
  /// The geometric stiffness at f.
  Eigen::Matrix<double, 12, 12> geometric(const S::Vec& f) const;
  /// d(rate)/dq over (qA, qB), 6 x 12, for the motions from which the pose was made. Eqs. (3.12), (3.13).
  Eigen::Matrix<double, 6, 12> rate_gradient(const S::Motion& A, const S::Motion& B) const;
};

template <class T>
SpatialGapMap<T> SpatialGapMap<T>::of(const SpatialRelativePose& pose) {
  return same(pose.map);
}
template <>
inline SpatialGapMap<double> SpatialGapMap<double>::of(const SpatialRelativePose& pose) {
  return pose.map;
}

}  // namespace pintle
