// Eight variants of one mechanism in register lanes: the counterpart of System. Joints are relative poses with a spring
// and a damper in each component; loads are evaluated per variant.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "probes/gap_map.h"
#include "solve/block_lu.h"
#include "system/system.h"

namespace pintle {

constexpr int kFleet = 8;     // variants: what hides the latency of a chain of operations that wait for each other
constexpr int kFleetStages = 3;  // of their steps
using Each = Lanes<kFleet>;  // a number of each
using EachVec = BlockVec<Each, 3>;
using EachVecs = std::vector<EachVec>;  // per body, with one more for the ground; or per joint

struct FleetFrame {
  struct Point {
    Each along, across;
    const Each& x() const { return along; }
    const Each& y() const { return across; }
  } p;
  Each angle, c, s;
};

struct FleetBody {
  EachVec mass, over_mass, weight;
};

struct FleetJoint {
  Placement at;              // the bodies; its frames are not used
  int a = 0, b = 0;          // where the bodies stand in EachVecs
  BlockPattern::Slot slot{};
  FleetFrame F, M;
  EachVec offset, k, c, over_k;
  std::array<bool, 3> stiff{};  // components with a stiffness
  int servo = -1;
};

struct FleetMotion {
  Each x, y, angle, c, s, vx, vy, w;
};

struct FleetReading {
  EachVec gap, rate, bias;
  GapMap<Each> map;
};

/// An instant of all variants. The vectors of bodies have one entry more, for the ground.
struct FleetState {
  Each t;
  EachVecs q, v, a;
  EachVecs gap, rate, accel, force;

  FleetState() = default;
  FleetState(std::size_t bodies, std::size_t joints)
      : t(0.0), q(bodies + 1), v(bodies + 1), a(bodies + 1), gap(joints), rate(joints), accel(joints), force(joints) {}
};

struct FleetStep {
  double share = 0;            // of the duration
  std::vector<double> inside;  // times of results, as shares of the step
  bool at_end = false;         // there is a result at its end
};

/// The largest forces so far, at times of results.
struct FleetPeak {
  Each square = Each(0.0), time = Each(0.0), couple = Each(0.0);  // of the magnitude [N^2], when [s], [N*m]
};

class FleetMechanism {
 public:
  /// Room for variants of `base`.
  explicit FleetMechanism(const System& base);

  /// Whether systems of this kind can stand in a fleet at all.
  static bool takes(const System& system);

  /// Puts a variant into a lane; it must stay where it is.
  void put(int lane, const System& variant);

  std::vector<FleetBody> bodies;
  std::vector<FleetJoint> joints;
  const BlockPattern& pattern() const { return *pattern_; }
  std::size_t n_bodies() const { return bodies.size(); }

  PINTLE_LANES void motions(const EachVecs& q, const EachVecs& v, std::vector<FleetMotion>& out) const {
    Each angles(0.0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      FleetMotion& m = out[i];
      m.x = q[i][0];
      m.y = q[i][1];
      m.angle = q[i][2];
      sine_and_cosine_unchecked(m.angle, m.s, m.c);
      angles = larger_size(angles, m.angle);
    }
    if (any_beyond_largest_angle(angles))
      for (std::size_t i = 0; i < bodies.size(); ++i) sine_and_cosine(out[i].angle, out[i].s, out[i].c);
    rates(v, out);
    FleetMotion& ground = out.back();
    ground = FleetMotion{Each(0.0), Each(0.0), Each(0.0), Each(1.0), Each(0.0), Each(0.0), Each(0.0), Each(0.0)};
  }

  /// Of bodies that have not moved.
  PINTLE_LANES void rates(const EachVecs& v, std::vector<FleetMotion>& out) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      out[i].vx = v[i][0];
      out[i].vy = v[i][1];
      out[i].w = v[i][2];
    }
  }

  PINTLE_LANES void readings(const Each& t, const std::vector<FleetMotion>& m, std::vector<FleetReading>& out) const {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const FleetJoint& joint = joints[j];
      const FleetMotion &A = m[joint.a], &B = m[joint.b];
      const auto g = PoseGeometry<Each>::between(A, joint.F, B, joint.M);
      FleetReading& r = out[j];
      r.map.take(g);
      const Each rx = g.rx + A.w * g.dy, ry = g.ry - A.w * g.dx;
      r.gap[0] = g.c * g.dx + g.s * g.dy - joint.offset[0];
      r.gap[1] = g.c * g.dy - g.s * g.dx - joint.offset[1];
      r.gap[2] = B.angle + joint.M.angle - A.angle - joint.F.angle - joint.offset[2];
      r.rate[0] = g.c * rx + g.s * ry;
      r.rate[1] = g.c * ry - g.s * rx;
      r.rate[2] = B.w - A.w;
      r.bias[0] = g.bias_x;
      r.bias[1] = g.bias_y;
      r.bias[2] = Each(0.0);
      if (joint.servo >= 0) take_off_target(j, t, r);
    }
  }

  /// Maps and convective accelerations only.
  PINTLE_LANES void maps(const Each& t, const std::vector<FleetMotion>& m, std::vector<GapMap<Each>>& map, EachVecs& bias) const {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const FleetJoint& joint = joints[j];
      const auto g = PoseGeometry<Each>::between(m[joint.a], joint.F, m[joint.b], joint.M);
      map[j].take(g);
      bias[j][0] = g.bias_x;
      bias[j][1] = g.bias_y;
      bias[j][2] = Each(0.0);
      if (joint.servo >= 0) take_off_accel(j, t, bias[j]);
    }
  }

  PINTLE_LANES void external(const Each& t, const std::vector<FleetMotion>& m, EachVecs& Q) {
    for (std::size_t i = 0; i < bodies.size(); ++i) Q[i] = bodies[i].weight;
    Q.back() = {};
    if (loads_) add_loads(t, m, Q);
  }
  bool has_loads() const { return loads_; }
  /// Calls add(lane, i, j, dQ_i/dq_j, dQ_i/dv_j) for every block.
  template <class Add>
  void load_tangents(const Each& t, const std::vector<FleetMotion>& m, Add&& add) {
    if (!loads_) return;
    for (int lane = 0; lane < kFleet; ++lane) {
      take_motions(m, lane);
      variant_[lane]->external_tangents(t[lane], motions_, [&](int i, int j, const Planar::Mat& dq, const Planar::Mat& dv) { add(lane, i, j, dq, dv); });
    }
  }

  PINTLE_LANES static EachVec law_force(const FleetJoint& joint, const EachVec& gap, const EachVec& rate) {
    EachVec f;
    for (int k = 0; k < 3; ++k) f[k] = -(joint.k[k] * gap[k] + joint.c[k] * rate[k]);
    return f;
  }

  /// on_bodies += G' f.
  PINTLE_LANES static void add_force(const FleetJoint& joint, const GapMap<Each>& map, const EachVec& f, EachVecs& on_bodies) {
    map.push(f.a.data(), on_bodies[joint.a], on_bodies[joint.b]);
  }
  /// G x.
  PINTLE_LANES static EachVec gap_change(const FleetJoint& joint, const GapMap<Each>& map, const EachVecs& x) {
    EachVec e;
    map.gather(x[joint.a].a.data(), x[joint.b].a.data(), e.a.data());
    return e;
  }

 private:
  void take_off_target(std::size_t j, const Each& t, FleetReading& r) const;
  void take_off_accel(std::size_t j, const Each& t, EachVec& bias) const;
  void take_motions(const std::vector<FleetMotion>& m, int lane);
  void add_loads(const Each& t, const std::vector<FleetMotion>& m, EachVecs& Q);

  const BlockPattern* pattern_;
  bool loads_;
  std::array<const System*, kFleet> variant_{};
  std::vector<Planar::Motion> motions_;  // of one variant
  Vecs Q_;
};

}  // namespace pintle
