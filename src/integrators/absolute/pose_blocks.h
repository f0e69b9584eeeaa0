// What a joint adds to the matrices of implicit methods: for joints of any kind, and faster where the gap is the relative pose and
// the law has a spring and a damper in each component.
#pragma once

#include "linalg/block_lu.h"
#include "system/system.h"

namespace pintle {

/// Springs and dampers give symmetric matrices.
template <class S>
Symmetry symmetry_of_joints(const BasicSystem<S>& system) {
  for (const BasicJointData<S>& joint : system.joints)
    if (!joint.law.as_linear()) return Symmetry::kNone;
  return Symmetry::kSymmetric;
}

/// G' w G of the pair of bodies of a joint whose gap is their relative pose: w holds the stiffness of each component.
template <class S, class T>
struct PoseBlocks;

/// In the plane. In world axes w is a symmetric stiffness (xx, xy,
/// yy) at the joint's point, which acts at the arms of both bodies, and a rotational stiffness. joints Eqs. (2.5), (2.6), (2.9).
template <class T>
struct PoseBlocks<Planar, T> {
  T xx, xy, yy;
  T ax, ay, aa;  // of the first body with its angle
  T bx, by, bb;
  T ba;          // of both angles

  template <class Real>
  PINTLE_LANES static PoseBlocks of(const PlanarGapMap<Real>& g, const T* w) {
    PoseBlocks k;
    k.xx = (g.c * g.c) * w[0] + (g.s * g.s) * w[1];
    k.yy = (g.s * g.s) * w[0] + (g.c * g.c) * w[1];
    k.xy = (g.c * g.s) * (w[0] - w[1]);
    k.ax = g.ax * k.xy - g.ay * k.xx;
    k.ay = g.ax * k.yy - g.ay * k.xy;
    k.bx = g.bx * k.xy - g.by * k.xx;
    k.by = g.bx * k.yy - g.by * k.xy;
    k.aa = w[2] + g.ax * k.ay - g.ay * k.ax;
    k.bb = w[2] + g.bx * k.by - g.by * k.bx;
    k.ba = w[2] + g.bx * k.ay - g.by * k.ax;
    return k;
  }
  /// Minus N, at a force [N, N, N*m].
  template <class Real, class Force>
  PINTLE_LANES static PoseBlocks of(const PlanarGapMap<Real>& g, const T* w, const Force& force) {
    PoseBlocks k = of(g, w);
    const T one(1.0), fx = (g.c * force[0] - g.s * force[1]) * one, fy = (g.s * force[0] + g.c * force[1]) * one;
    k.ax -= fy;
    k.ay += fx;
    k.aa += g.ax * fx + g.ay * fy;
    k.bb += g.bx * fx + g.by * fy;
    k.ba += g.bx * fx + g.by * fy;
    return k;
  }

  /// The blocks of one lane.
  PINTLE_LANES PoseBlocks<Planar, double> lane(int i) const { return {xx[i], xy[i], yy[i], ax[i], ay[i], aa[i], bx[i], by[i], bb[i], ba[i]}; }
  /// Adds it to the blocks of bodies a and b, which may be the ground.
  PINTLE_LANES void add_to(BlockLu<T, 3>& lu, int a, int b, BlockPattern::Slot slot) const {
    if (a != kGround) add_diagonal(lu.diagonal(a), ax, ay, aa, !lu.symmetric());
    if (b != kGround) add_diagonal(lu.diagonal(b), bx, by, bb, !lu.symmetric());
    if (a == kGround || b == kGround) return;
    if (lu.has(slot)) subtract(lu.off_diagonal(slot), bx, by, ax, ay);
    slot.upper = !slot.upper;
    if (lu.has(slot)) subtract(lu.off_diagonal(slot), ax, ay, bx, by);
  }
  PINTLE_LANES void add_to(BlockLu<T, 3>& lu, const Placement& at, BlockPattern::Slot slot) const { add_to(lu, at.a, at.b, slot); }

 private:
  PINTLE_LANES void add_diagonal(Block<T, 3>& block, const T& x, const T& y, const T& turn, bool whole) const {
    block(0, 0) += xx;
    block(1, 0) += xy; block(1, 1) += yy;
    block(2, 0) += x; block(2, 1) += y; block(2, 2) += turn;
    if (!whole) return;
    block(0, 1) += xy; block(0, 2) += x; block(1, 2) += y;
  }
  PINTLE_LANES void subtract(Block<T, 3>& block, const T& x, const T& y, const T& down_x, const T& down_y) const {
    block(0, 0) -= xx; block(0, 1) -= xy; block(0, 2) -= x;
    block(1, 0) -= xy; block(1, 1) -= yy; block(1, 2) -= y;
    block(2, 0) -= down_x; block(2, 1) -= down_y; block(2, 2) -= ba;
  }
};

/// The same in space. The rows of G of a joint's force are its axes in the world and their moments about both centres, those of its couple have moments
/// alone. space Eqs. (3.7)-(3.11).
template <class T>
struct PoseBlocks<Spatial, T> {
  static constexpr int n = Spatial::kDof;
  Block<T, n> aa, ab, ba, bb;

  template <class Real>
  PINTLE_LANES static PoseBlocks of(const SpatialGapMap<Real>& g, const T* w) {
    const Real zero(0.0), one(1.0);
    const Matrix3<Real>& F = g.RF;
    const Vector3<Real> axis[3] = {{F.xx, F.yx, F.zx}, {F.xy, F.yy, F.zy}, {F.xz, F.yz, F.zz}};
    const Vector3<Real> turning[3] = {F * Vector3<Real>{g.n.z, zero, -g.n.x}, F * Vector3<Real>{zero, g.n.z, -g.n.y}, F * Vector3<Real>{g.k * g.n.x, g.k * g.n.y, one}};
    PoseBlocks k;
    for (Block<T, n>* block : {&k.aa, &k.ab, &k.ba, &k.bb})
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) (*block)(r, c) = T(0.0);
    for (int i = 0; i < 3; ++i) {
      const Vector3<Real> on_a = turned_back(g.RA, cross(g.arm_a, axis[i])), on_b = turned_back(g.RB, cross(g.arm_b, axis[i]));
      const Vector3<T> force = scaled(axis[i], w[i]), moment_a = scaled(on_a, w[i]), moment_b = scaled(on_b, w[i]);
      add_product(k.bb, 0, 0, axis[i], force);
      add_product(k.bb, 0, 3, axis[i], moment_b);
      add_product(k.bb, 3, 3, on_b, moment_b);
      add_product(k.aa, 0, 3, axis[i], moment_a);
      add_product(k.aa, 3, 3, on_a, moment_a);
      add_product(k.ab, 3, 3, on_a, moment_b);
    }
    for (int i = 0; i < 3; ++i) {
      const Vector3<Real> on_a = turned_back(g.RA, turning[i]), on_b = turned_back(g.RB, turning[i]);
      const Vector3<T> moment_a = scaled(on_a, w[3 + i]), moment_b = scaled(on_b, w[3 + i]);
      add_product(k.bb, 3, 3, on_b, moment_b);
      add_product(k.aa, 3, 3, on_a, moment_a);
      add_product(k.ab, 3, 3, on_a, moment_b);
    }
    k.complete();
    return k;
  }
  /// Minus N, at a force [N, N, N, N*m, N*m, N*m].
  PINTLE_LANES static PoseBlocks of(const SpatialGapMap<double>& g, const T* w, const Spatial::Vec& force) {
    PoseBlocks k = of(g, w);
    const auto N = geometric_stiffness(g, force);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        k.aa(r, c) -= T(N(r, c));
        k.ab(r, c) -= T(N(r, n + c));
        k.ba(r, c) -= T(N(n + r, c));
        k.bb(r, c) -= T(N(n + r, n + c));
      }
    return k;
  }

  /// The blocks of one lane.
  PINTLE_LANES PoseBlocks<Spatial, double> lane(int i) const {
    PoseBlocks<Spatial, double> one;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        one.aa(r, c) = aa(r, c)[i];
        one.ab(r, c) = ab(r, c)[i];
        one.ba(r, c) = ba(r, c)[i];
        one.bb(r, c) = bb(r, c)[i];
      }
    return one;
  }
  /// Adds it to the blocks of bodies a and b, which may be the ground.
  PINTLE_LANES void add_to(BlockLu<T, n>& lu, int a, int b, BlockPattern::Slot slot) const {
    if (a != kGround) add(lu.diagonal(a), aa);
    if (b != kGround) add(lu.diagonal(b), bb);
    if (a == kGround || b == kGround) return;
    if (lu.has(slot)) add(lu.off_diagonal(slot), ab);
    slot.upper = !slot.upper;
    if (lu.has(slot)) add(lu.off_diagonal(slot), ba);
  }
  PINTLE_LANES void add_to(BlockLu<T, n>& lu, const BasicPlacement<Spatial>& at, BlockPattern::Slot slot) const { add_to(lu, at.a, at.b, slot); }

 private:
  template <class Real>
  PINTLE_LANES static Vector3<T> scaled(const Vector3<Real>& x, const T& by) {
    return {x.x * by, x.y * by, x.z * by};
  }
  // block += x y', from that row and column on.
  template <class Real>
  PINTLE_LANES static void add_product(Block<T, n>& block, int row, int column, const Vector3<Real>& x, const Vector3<T>& y) {
    const Real* of_row[3] = {&x.x, &x.y, &x.z};
    const T* of_column[3] = {&y.x, &y.y, &y.z};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) block(row + r, column + c) += *of_row[r] * *of_column[c];
  }
  // The first body has the opposite of the force; every block is symmetric or the other's transpose.
  PINTLE_LANES void complete() {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        aa(r, c) = bb(r, c);
        bb(3 + c, r) = bb(r, 3 + c);
        aa(3 + c, r) = aa(r, 3 + c);
        ab(r, c) = -bb(r, c);
        ab(r, 3 + c) = -bb(r, 3 + c);
        ab(3 + r, c) = -aa(c, 3 + r);
        ab(3 + r, 3 + c) = -ab(3 + r, 3 + c);
      }
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) ba(c, r) = ab(r, c);
  }
  PINTLE_LANES static void add(Block<T, n>& to, const Block<T, n>& k) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) to(r, c) += k(r, c);
  }
};

/// Adds G' w G to the blocks of both bodies, for a gap and a law of any kind.
template <class S>
void add_gap_blocks(BlockLu<double, S::kDof>& lu, const BasicPlacement<S>& at, BlockPattern::Slot slot, const typename S::template GapMap<double>& g, const typename S::Mat& w) {
  using Mat = typename S::Mat;
  const auto add = [](Block<double, S::kDof>& block, const Mat& m) {
    for (int i = 0; i < S::kDof; ++i)
      for (int j = 0; j < S::kDof; ++j) block(i, j) += m(i, j);
  };
  const Mat GA = g.GA(), GB = g.GB(), WA = w * GA, WB = w * GB;
  if (at.a != kGround) add(lu.diagonal(at.a), GA.transpose() * WA);
  if (at.b != kGround) add(lu.diagonal(at.b), GB.transpose() * WB);
  if (at.a == kGround || at.b == kGround) return;
  if (lu.has(slot)) add(lu.off_diagonal(slot), GA.transpose() * WB);
  slot.upper = !slot.upper;
  if (lu.has(slot)) add(lu.off_diagonal(slot), GB.transpose() * WA);
}

}  // namespace pintle
