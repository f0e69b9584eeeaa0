// Joints in groups of four, one per lane: attachment points, gaps and forces.
#pragma once

#include <vector>

#include "integrators/absolute/pose_blocks.h"
#include "integrators/absolute/stage_lanes.h"
#include "simd/fetch.h"
#include "system/system.h"

namespace pintle {

/// Three numbers of a body.
using BodyRow = BlockVec<double, Planar::kDof>;

/// Where a body is and how it moves, for joints that look at four of them.
struct BodyAt {
  Lanes<4> place;   // x, y [m], angle [rad], its cosine
  Lanes<4> motion;  // its sine, velocities [m/s, m/s, rad/s]

  PINTLE_LANES void set(const Planar::Motion& m) {
    place = Lanes<4>::of({m.p.x(), m.p.y(), m.angle, m.c});
    motion = Lanes<4>::of({m.s, m.v.x(), m.v.y(), m.w});
  }
};

/// Up to four joints with a spring and a damper in each component of the relative pose; or one joint of another kind, in every lane.
struct JointPack {
  using L = Lanes<4>;
  struct Point {
    L across, up;
    const L& x() const { return across; }
    const L& y() const { return up; }
  };
  struct AttachmentFrame {
    Point p;
    L c, s, angle;
  };
  struct Kinematics {
    L gap[3], rate[3], bias[3];
  };

  AttachmentFrame F, M;
  L offset[3], k[3], c[3];
  L forbidden[3];          // components: 1; free ones: 0
  L weight[9];             // K + mu C by rows; the first three of springs and dampers
  GapMap<L> map;           // as in the matrix
  int first = 0, n = 0;    // joints
  int lane[4] = {};        // the joint in each; those beyond n follow the last one
  int a[4] = {}, b[4] = {};  // their bodies; the ground stands behind the last one
  BlockPattern::Slot slot[4] = {};  // of their bodies, A before B
  bool linear = false;     // springs and dampers
  bool pose = false;       // the same in the relative pose
  bool slides = false;     // one of them leaves a component of translation free

  /// Component k of what there is for each joint.
  PINTLE_LANES L load(const std::vector<Planar::Vec>& x, int component) const {
    return L::of({x[lane[0]][component], x[lane[1]][component], x[lane[2]][component], x[lane[3]][component]});
  }
  PINTLE_LANES void store(const L (&from)[3], std::vector<Planar::Vec>& x) const {
    for (int i = 0; i < n; ++i)
      for (int component = 0; component < 3; ++component) x[first + i][component] = from[component].v[i];
  }

  /// What they read and write of x, by joint or by body, will be asked for soon.
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

  /// Their gaps and the map there, of springs and dampers in the pose. joints Eqs. (2.1)-(2.5).
  PINTLE_LANES void read_poses(const std::vector<BodyAt>& at, Kinematics& r, GapMap<L>& map_there) const {
    const View A = View::of(at, a), B = View::of(at, b);
    const auto g = PoseGeometry<L>::between(A, F, B, M);
    map_there.set(g);
    const L rx = g.rx + A.w * g.dy, ry = g.ry - A.w * g.dx;
    r.gap[0] = g.c * g.dx + g.s * g.dy - offset[0];
    r.gap[1] = g.c * g.dy - g.s * g.dx - offset[1];
    r.gap[2] = B.angle + M.angle - A.angle - F.angle - offset[2];
    r.rate[0] = g.c * rx + g.s * ry;
    r.rate[1] = g.c * ry - g.s * rx;
    r.rate[2] = B.w - A.w;
    r.bias[0] = g.bias_x;
    r.bias[1] = g.bias_y;
    r.bias[2] = L::all(0);
  }

  /// on_bodies += G' f, by the map of the matrix.
  PINTLE_LANES void push(const L* f, std::vector<BodyRow>& on_bodies) const {
    const auto on = map.spread(f);
    push({-on.fx, -on.fy, on.ma}, {on.fx, on.fy, on.mb}, on_bodies);
  }
  /// on_bodies += the magnitudes of that.
  PINTLE_LANES void push_magnitudes(const L* f, std::vector<BodyRow>& on_bodies) const {
    const auto on = map.spread(f);
    const L x = sizes(on.fx), y = sizes(on.fy);
    push({x, y, sizes(on.ma)}, {x, y, sizes(on.mb)}, on_bodies);
  }
  /// G x of bodies and the ground, by one of the joints' maps.
  PINTLE_LANES void gather(const GapMap<L>& by, const std::vector<BodyRow>& x, L (&gap)[3]) const {
    L of_a[4] = {x[a[0]].lanes(), x[a[1]].lanes(), x[a[2]].lanes(), x[a[3]].lanes()};
    L of_b[4] = {x[b[0]].lanes(), x[b[1]].lanes(), x[b[2]].lanes(), x[b[3]].lanes()};
    transpose(of_a);
    transpose(of_b);
    by.gather(of_a, of_b, gap);
  }

 private:
  struct View {
    L x, y, angle, c, s, vx, vy, w;

    PINTLE_LANES static View of(const std::vector<BodyAt>& at, const int (&body)[4]) {
      L place[4] = {at[body[0]].place, at[body[1]].place, at[body[2]].place, at[body[3]].place};
      L motion[4] = {at[body[0]].motion, at[body[1]].motion, at[body[2]].motion, at[body[3]].motion};
      transpose(place);
      transpose(motion);
      return {place[0], place[1], place[2], place[3], motion[0], motion[1], motion[2], motion[3]};
    }
  };

  PINTLE_LANES static void add(const L& x, BodyRow& to) { to.set(to.lanes() + x); }
  PINTLE_LANES void push(const L (&on_a)[3], const L (&on_b)[3], std::vector<BodyRow>& on_bodies) const {
    L row_a[4] = {on_a[0], on_a[1], on_a[2], L::all(0)}, row_b[4] = {on_b[0], on_b[1], on_b[2], L::all(0)};
    transpose(row_a);
    transpose(row_b);
    for (int i = 0; i < n; ++i) {
      add(row_a[i], on_bodies[a[i]]);
      add(row_b[i], on_bodies[b[i]]);
    }
  }
};

/// The joints of a mechanism in packs, in their order.
std::vector<JointPack> pack_joints(const System& system);

}  // namespace pintle
