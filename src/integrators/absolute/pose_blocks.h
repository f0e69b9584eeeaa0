// What a joint adds to the matrices of implicit methods: for joints of any kind, and faster where the gap is the relative pose and
// the law has a spring and a damper in each component.
#pragma once

#include <tuple>
#include <type_traits>

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

/// G' w G of a pair of bodies: w holds the stiffness of each component.
template <class S, class T>
struct PoseBlocks {
  static constexpr int n = S::kDof;
  Block<T, n> aa, ab, ba, bb;

  template <class Map>
  PINTLE_LANES static PoseBlocks of(const Map& g, const T* w) {
    using Real = std::decay_t<decltype(g.k)>;
    Real G[2][n][n];  // of each body, by columns
    for (int body = 0; body < 2; ++body)
      for (int c = 0; c < n; ++c) {
        Real x[2][n];
        for (auto& of_body : x)
          for (Real& y : of_body) y = Real(0.0);
        x[body][c] = Real(1.0);
        g.gather(x[0], x[1], G[body][c]);
      }
    PoseBlocks k;
    for (const auto& [block, row, column] : {std::tuple(&k.aa, 0, 0), std::tuple(&k.ab, 0, 1), std::tuple(&k.ba, 1, 0), std::tuple(&k.bb, 1, 1)})
      for (int c = 0; c < n; ++c) {
        T force[n];
        for (int i = 0; i < n; ++i) force[i] = G[column][c][i] * w[i];
        for (int r = 0; r < n; ++r) {
          T sum = G[row][r][0] * force[0];
          for (int i = 1; i < n; ++i) sum += G[row][r][i] * force[i];
          (*block)(r, c) = sum;
        }
      }
    return k;
  }

  /// The blocks of one lane.
  PINTLE_LANES PoseBlocks<S, double> lane(int i) const {
    PoseBlocks<S, double> one;
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
  PINTLE_LANES void add_to(BlockLu<T, n>& lu, const BasicPlacement<S>& at, BlockPattern::Slot slot) const { add_to(lu, at.a, at.b, slot); }

 private:
  PINTLE_LANES static void add(Block<T, n>& to, const Block<T, n>& k) {
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) to(r, c) += k(r, c);
  }
};

/// The same in the plane, minus N, the geometric stiffness at the joint's force. In world axes w is a symmetric stiffness (xx, xy,
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
