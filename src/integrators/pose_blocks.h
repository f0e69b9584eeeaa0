// What a joint adds to the matrices of implicit methods: of any kind, and faster where its gap is the relative pose and its law has a
// spring and a damper in each component.
#pragma once

#include "solve/block_lu.h"
#include "system/system.h"

namespace pintle {

/// Springs and dampers make symmetric matrices.
inline Symmetry symmetry_of_joints(const System& system) {
  for (const JointData& joint : system.joints)
    if (!std::holds_alternative<LinearLaw>(joint.law)) return Symmetry::kNone;
  return Symmetry::kSymmetric;
}

/// Adds G' w G - N to the blocks of both bodies: w stands for stiffness in each component, N is the geometric stiffness at the
/// joint's force. In world axes w is a symmetric stiffness (xx, xy, yy) at the joint's point, which acts at the arms of both
/// bodies, and one against turning. joints Eqs. (2.5), (2.6), (2.9).
template <class T, class Real, class Force>
PINTLE_LANES void add_pose_blocks(BlockLu<T, 3>& lu, const Placement& at, BlockPattern::Slot slot, const GapMap<Real>& g, const T* w,
                                  const Force& force) {
  const T one(1.0), xx = (g.c * g.c) * w[0] + (g.s * g.s) * w[1], yy = (g.s * g.s) * w[0] + (g.c * g.c) * w[1], xy = (g.c * g.s) * (w[0] - w[1]);
  const T fx = (g.c * force[0] - g.s * force[1]) * one, fy = (g.s * force[0] + g.c * force[1]) * one;
  const T ax = g.ax * xy - g.ay * xx - fy, ay = g.ax * yy - g.ay * xy + fx;
  const T bx = g.bx * xy - g.by * xx, by = g.bx * yy - g.by * xy;
  const auto add_lower = [](Block<T, 3>& block, const T& k, const T& l, const T& m, const T& tx, const T& ty, const T& tt) {
    block(0, 0) += k;
    block(1, 0) += l; block(1, 1) += m;
    block(2, 0) += tx; block(2, 1) += ty; block(2, 2) += tt;
  };
  const auto add_upper = [](Block<T, 3>& block, const T& l, const T& xt, const T& yt) {
    block(0, 1) += l; block(0, 2) += xt;
    block(1, 2) += yt;
  };
  const auto add_diagonal = [&](Block<T, 3>& block, const T& x, const T& y, const T& tt) {
    add_lower(block, xx, xy, yy, x, y, tt);
    if (!lu.symmetric()) add_upper(block, xy, x, y);
  };
  const auto add = [&](Block<T, 3>& block, const T& k, const T& l, const T& m, const T& xt, const T& yt, const T& tx, const T& ty, const T& tt) {
    add_lower(block, k, l, m, tx, ty, tt);
    add_upper(block, l, xt, yt);
  };
  if (at.a != kGround) add_diagonal(lu.diagonal(at.a), ax, ay, w[2] + g.ax * ay - g.ay * ax);
  if (at.b != kGround) add_diagonal(lu.diagonal(at.b), bx, by, w[2] + g.bx * (by + fx) - g.by * (bx - fy));
  if (at.a == kGround || at.b == kGround) return;
  const T both = w[2] + g.bx * ay - g.by * ax;
  if (lu.has(slot)) add(lu.off_diagonal(slot), -xx, -xy, -yy, -bx, -by, -ax, -ay, -both);
  slot.upper = !slot.upper;
  if (lu.has(slot)) add(lu.off_diagonal(slot), -xx, -xy, -yy, -ax, -ay, -bx, -by, -both);
}

/// Adds G' w G to the blocks of both bodies, for a gap and a law of any kind.
inline void add_gap_blocks(BlockLu<double, 3>& lu, const Placement& at, BlockPattern::Slot slot, const GapMap<double>& g, const Planar::Mat& w) {
  using Mat = Planar::Mat;
  const auto add = [](Block<double, 3>& block, const Mat& m) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) block(i, j) += m(i, j);
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
