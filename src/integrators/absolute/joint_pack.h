// Joints in groups of four, one per lane: attachment points, gaps and forces.
#pragma once

#include <vector>

#include "integrators/absolute/pose_blocks.h"
#include "integrators/radau/stage_lanes.h"
#include "simd/fetch.h"
#include "system/system.h"

namespace pintle {

/// One number for each degree of freedom of a body.
template <class S>
using BodyRow = BlockVec<double, S::kDof>;

/// Loads the rows of four bodies into lanes, component by component.
PINTLE_LANES void load_rows(const std::vector<BodyRow<Planar>>& x, const int (&body)[4], Lanes<4> (&out)[Planar::kDof]) {
  Lanes<4> rows[4] = {x[body[0]].lanes(), x[body[1]].lanes(), x[body[2]].lanes(), x[body[3]].lanes()};
  transpose(rows);
  for (int k = 0; k < Planar::kDof; ++k) out[k] = rows[k];
}
PINTLE_LANES void load_rows(const std::vector<BodyRow<Spatial>>& x, const int (&body)[4], Lanes<4> (&out)[Spatial::kDof]) {
  for (int k = 0; k < Spatial::kDof; ++k) out[k] = Lanes<4>::of({x[body[0]][k], x[body[1]][k], x[body[2]][k], x[body[3]][k]});
}
/// Adds the rows of two bodies of each of n joints, joint by joint.
PINTLE_LANES void add_rows(const Lanes<4> (&on_a)[Planar::kDof], const Lanes<4> (&on_b)[Planar::kDof], int n, const int (&a)[4], const int (&b)[4], std::vector<BodyRow<Planar>>& x) {
  Lanes<4> row_a[4] = {on_a[0], on_a[1], on_a[2], Lanes<4>::all(0)}, row_b[4] = {on_b[0], on_b[1], on_b[2], Lanes<4>::all(0)};
  transpose(row_a);
  transpose(row_b);
  for (int i = 0; i < n; ++i) {
    x[a[i]].set(x[a[i]].lanes() + row_a[i]);
    x[b[i]].set(x[b[i]].lanes() + row_b[i]);
  }
}
PINTLE_LANES void add_rows(const Lanes<4> (&on_a)[Spatial::kDof], const Lanes<4> (&on_b)[Spatial::kDof], int n, const int (&a)[4], const int (&b)[4], std::vector<BodyRow<Spatial>>& x) {
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < Spatial::kDof; ++k) {
      x[a[i]][k] += on_a[k][i];
      x[b[i]][k] += on_b[k][i];
    }
}

/// Position and motion of a body, for joints that read four of them at once.
template <class S>
struct BodyAt;
template <>
struct BodyAt<Planar> {
  Lanes<4> place;   // x, y [m], angle [rad], its cosine
  Lanes<4> motion;  // its sine, velocities [m/s, m/s, rad/s]

  PINTLE_LANES void set(const Planar::Motion& m) {
    place = Lanes<4>::of({m.p.x(), m.p.y(), m.angle, m.c});
    motion = Lanes<4>::of({m.s, m.v.x(), m.v.y(), m.w});
  }
  struct View {
    Lanes<4> x, y, angle, c, s, vx, vy, w;
  };
  PINTLE_LANES static View view(const std::vector<BodyAt>& at, const int (&body)[4]) {
    Lanes<4> place[4] = {at[body[0]].place, at[body[1]].place, at[body[2]].place, at[body[3]].place};
    Lanes<4> motion[4] = {at[body[0]].motion, at[body[1]].motion, at[body[2]].motion, at[body[3]].motion};
    transpose(place);
    transpose(motion);
    return {place[0], place[1], place[2], place[3], motion[0], motion[1], motion[2], motion[3]};
  }
};
template <>
struct BodyAt<Spatial> {
  Spatial::Motion m;

  PINTLE_LANES void set(const Spatial::Motion& motion) { m = motion; }
  PINTLE_LANES static SpatialBodyView<Lanes<4>> view(const std::vector<BodyAt>& at, const int (&body)[4]) {
    const auto four = [&](auto&& of) { return Lanes<4>::of({of(at[body[0]].m), of(at[body[1]].m), of(at[body[2]].m), of(at[body[3]].m)}); };
    const auto vector = [&](Spatial::Point Spatial::Motion::*x) {
      return Vector3<Lanes<4>>{four([&](const auto& motion) { return (motion.*x)[0]; }), four([&](const auto& motion) { return (motion.*x)[1]; }), four([&](const auto& motion) { return (motion.*x)[2]; })};
    };
    const auto entry = [&](int r, int c) { return four([&](const auto& motion) { return motion.R(r, c); }); };
    return {vector(&Spatial::Motion::p),
            {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1), entry(1, 2), entry(2, 0), entry(2, 1), entry(2, 2)},
            vector(&Spatial::Motion::v), vector(&Spatial::Motion::w)};
  }
};

/// An attachment frame of each of four joints.
template <class S>
struct PackedFrame;
template <>
struct PackedFrame<Planar> {
  using L = Lanes<4>;
  struct Point {
    L across, up;
    const L& x() const { return across; }
    const L& y() const { return up; }
  };
  Point p;
  L c, s, angle;

  void set(int lane, const Planar::Frame& frame) {
    p.across.set(lane, frame.p.x());
    p.up.set(lane, frame.p.y());
    c.set(lane, frame.c);
    s.set(lane, frame.s);
    angle.set(lane, frame.angle);
  }
};
template <>
struct PackedFrame<Spatial> : SpatialFrame<Lanes<4>> {
  void set(int lane, const Spatial::Frame& frame) {
    Lanes<4>* const to[] = {&R.xx, &R.xy, &R.xz, &R.yx, &R.yy, &R.yz, &R.zx, &R.zy, &R.zz};
    for (int i = 0; i < 9; ++i) to[i]->set(lane, frame.R(i / 3, i % 3));
    p.x.set(lane, frame.p.x());
    p.y.set(lane, frame.p.y());
    p.z.set(lane, frame.p.z());
  }
};

/// Up to four joints with a spring and a damper in each component of the relative pose; or one joint of another kind, in every lane.
template <class S>
struct BasicJointPack {
  using L = Lanes<4>;
  struct Kinematics {
    L gap[S::kDof], rate[S::kDof], bias[S::kDof];
  };

  PackedFrame<S> F, M;
  L offset[S::kDof], k[S::kDof], c[S::kDof];
  L forbidden[S::kDof];          // 1: component that the joint holds; 0: free one
  L weight[S::kDof * S::kDof];             // K + mu C by rows; for springs and dampers its diagonal
  typename S::template GapMap<L> map;           // as in the matrix
  int first = 0, n = 0;    // the first joint, and how many
  int lane[4] = {};        // the joint in each lane; lanes beyond n repeat the last one
  int a[4] = {}, b[4] = {};  // their bodies; the ground comes after the last one
  BlockPattern::Slot slot[4] = {};  // of their bodies, A before B
  bool linear = false;     // springs and dampers
  bool pose = false;       // the same, with the relative pose as the gap
  bool slides = false;     // one of them leaves a component of translation free

  /// One component of a quantity of each joint.
  PINTLE_LANES L load(const std::vector<typename S::Vec>& x, int component) const {
    return L::of({x[lane[0]][component], x[lane[1]][component], x[lane[2]][component], x[lane[3]][component]});
  }
  PINTLE_LANES void store(const L (&from)[S::kDof], std::vector<typename S::Vec>& x) const {
    for (int i = 0; i < n; ++i)
      for (int component = 0; component < S::kDof; ++component) x[first + i][component] = from[component].v[i];
  }

  /// Prefetch what the joints read and write of x, by joint or by body.
  template <class Row>
  PINTLE_LANES void fetch_joints(const std::vector<Row>& x) const {
    fetch(x, first, n);
  }
  template <class Row>
  PINTLE_LANES void fetch_bodies(const std::vector<Row>& x) const {
    for (int i = 0; i < n; ++i) {
      fetch(x, a[i]);
      fetch(x, b[i]);
    }
  }

  /// Their gaps and the map there, for springs and dampers in the pose. joints Eqs. (2.1)-(2.5).
  PINTLE_LANES void read_poses(const std::vector<BodyAt<S>>& at, Kinematics& r, typename S::template GapMap<L>& map_there) const {
    const auto A = BodyAt<S>::view(at, a), B = BodyAt<S>::view(at, b);
    const auto g = S::template PoseGeometry<L>::between(A, F, B, M);
    map_there.set(g);
    g.gaps(A, F, B, M, r.gap);
    for (int i = 0; i < S::kDof; ++i) r.gap[i] -= offset[i];
    g.rates(A, B, r.rate);
    g.biases(r.bias);
  }

  /// on_bodies += G' f, with the map of the matrix.
  PINTLE_LANES void push(const L* f, std::vector<BodyRow<S>>& on_bodies) const {
    L on_a[S::kDof], on_b[S::kDof];
    map.wrenches(f, on_a, on_b);
    add_rows(on_a, on_b, n, a, b, on_bodies);
  }
  /// on_bodies += the magnitudes of the same.
  PINTLE_LANES void push_magnitudes(const L* f, std::vector<BodyRow<S>>& on_bodies) const {
    L on_a[S::kDof] = {}, on_b[S::kDof] = {};
    map.push_magnitudes(f, on_a, on_b);
    add_rows(on_a, on_b, n, a, b, on_bodies);
  }
  /// G x for x of bodies and the ground, with one of the joints' maps.
  PINTLE_LANES void gather(const typename S::template GapMap<L>& by, const std::vector<BodyRow<S>>& x, L (&gap)[S::kDof]) const {
    L of_a[S::kDof], of_b[S::kDof];
    load_rows(x, a, of_a);
    load_rows(x, b, of_b);
    by.gather(of_a, of_b, gap);
  }
};

/// The joints of a mechanism in packs, in their order.
template <class S>
std::vector<BasicJointPack<S>> pack_joints(const BasicSystem<S>& system);

}  // namespace pintle
