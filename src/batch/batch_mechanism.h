// Eight variants of one mechanism in register lanes: the counterpart of System. Joints are relative poses with a spring
// and a damper in each component; loads are evaluated per variant.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "space/space.h"
#include "linalg/block_lu.h"
#include "system/system.h"

namespace pintle {

constexpr int kVariantLanes = 8;  // number of variants: enough to hide the latency of a chain of dependent operations
constexpr int kBatchStages = 3;  // stages of their steps
using VariantLanes = Lanes<kVariantLanes>;  // one number of each variant
using VariantVec = BlockVec<VariantLanes, 3>;
using VariantVecs = std::vector<VariantVec>;  // per body, with one more for the ground; or per joint

struct BatchFrame {
  struct Point {
    VariantLanes along, across;
    const VariantLanes& x() const { return along; }
    const VariantLanes& y() const { return across; }
  } p;
  VariantLanes angle, c, s;
};

struct BatchBody {
  VariantVec mass, over_mass, weight;
};

struct BatchJoint {
  Placement at;              // the bodies; its frames are not used
  int a = 0, b = 0;          // indices of the bodies in VariantVecs
  BlockPattern::Slot slot{};
  BatchFrame F, M;
  VariantVec offset, k, c, over_k;
  std::array<bool, 3> stiff{};  // components with a stiffness
  int servo = -1;
};

struct BatchMotion {
  VariantLanes x, y, angle, c, s, vx, vy, w;
};

struct BatchJointKinematics {
  VariantVec gap, rate, bias;
  GapMap<VariantLanes> map;
};

/// An instant of all variants. The vectors over bodies have one more entry, for the ground.
struct BatchState {
  VariantLanes t;
  VariantVecs q, v, a;
  VariantVecs gap, rate, accel, force;

  BatchState() = default;
  BatchState(std::size_t bodies, std::size_t joints)
      : t(0.0), q(bodies + 1), v(bodies + 1), a(bodies + 1), gap(joints), rate(joints), accel(joints), force(joints) {}
};

/// The largest loads so far.
struct BatchPeak {
  VariantLanes square = VariantLanes(0.0), time = VariantLanes(0.0);                // of the force [N^2], when [s]
  VariantLanes couple_square = VariantLanes(0.0), couple_time = VariantLanes(0.0);  // of the couple [N^2*m^2]
};

class BatchMechanism {
 public:
  /// Room for variants of `base`.
  explicit BatchMechanism(const System& base);

  /// Whether systems of this kind can be in a batch at all.
  static bool accepts(const System& system);

  /// Puts a variant into a lane; it must not be moved afterwards.
  void put(int lane, const System& variant);

  std::vector<BatchBody> bodies;
  std::vector<BatchJoint> joints;
  const BlockPattern& pattern() const { return *pattern_; }
  std::size_t n_bodies() const { return bodies.size(); }

  PINTLE_LANES void motions(const VariantVecs& q, const VariantVecs& v, std::vector<BatchMotion>& out) const {
    VariantLanes angles(0.0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      BatchMotion& m = out[i];
      m.x = q[i][0];
      m.y = q[i][1];
      m.angle = q[i][2];
      sine_and_cosine_unchecked(m.angle, m.s, m.c);
      angles = larger_size(angles, m.angle);
    }
    if (any_beyond_largest_angle(angles))
      for (std::size_t i = 0; i < bodies.size(); ++i) sine_and_cosine(out[i].angle, out[i].s, out[i].c);
    rates(v, out);
    BatchMotion& ground = out.back();
    ground = BatchMotion{VariantLanes(0.0), VariantLanes(0.0), VariantLanes(0.0), VariantLanes(1.0), VariantLanes(0.0), VariantLanes(0.0), VariantLanes(0.0), VariantLanes(0.0)};
  }

  /// Updates the rates of bodies that have not moved.
  PINTLE_LANES void rates(const VariantVecs& v, std::vector<BatchMotion>& out) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      out[i].vx = v[i][0];
      out[i].vy = v[i][1];
      out[i].w = v[i][2];
    }
  }

  PINTLE_LANES void joint_kinematics(const VariantLanes& t, const std::vector<BatchMotion>& m, std::vector<BatchJointKinematics>& out) const {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const BatchJoint& joint = joints[j];
      const BatchMotion &A = m[joint.a], &B = m[joint.b];
      const auto g = PoseGeometry<VariantLanes>::between(A, joint.F, B, joint.M);
      BatchJointKinematics& r = out[j];
      r.map.set(g);
      const VariantLanes rx = g.rx + A.w * g.dy, ry = g.ry - A.w * g.dx;
      r.gap[0] = g.c * g.dx + g.s * g.dy - joint.offset[0];
      r.gap[1] = g.c * g.dy - g.s * g.dx - joint.offset[1];
      r.gap[2] = B.angle + joint.M.angle - A.angle - joint.F.angle - joint.offset[2];
      r.rate[0] = g.c * rx + g.s * ry;
      r.rate[1] = g.c * ry - g.s * rx;
      r.rate[2] = B.w - A.w;
      r.bias[0] = g.bias_x;
      r.bias[1] = g.bias_y;
      r.bias[2] = VariantLanes(0.0);
      if (joint.servo >= 0) take_off_target(j, t, r);
    }
  }

  /// Maps and convective accelerations only.
  PINTLE_LANES void maps(const VariantLanes& t, const std::vector<BatchMotion>& m, std::vector<GapMap<VariantLanes>>& map, VariantVecs& bias) const {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const BatchJoint& joint = joints[j];
      const auto g = PoseGeometry<VariantLanes>::between(m[joint.a], joint.F, m[joint.b], joint.M);
      map[j].set(g);
      bias[j][0] = g.bias_x;
      bias[j][1] = g.bias_y;
      bias[j][2] = VariantLanes(0.0);
      if (joint.servo >= 0) take_off_accel(j, t, bias[j]);
    }
  }

  PINTLE_LANES void external(const VariantLanes& t, const std::vector<BatchMotion>& m, VariantVecs& Q) {
    for (std::size_t i = 0; i < bodies.size(); ++i) Q[i] = bodies[i].weight;
    Q.back() = {};
    if (loads_) add_loads(t, m, Q);
  }
  bool has_loads() const { return loads_; }
  /// Calls add(lane, i, j, dQ_i/dq_j, dQ_i/dv_j) for every block.
  template <class Add>
  void load_tangents(const VariantLanes& t, const std::vector<BatchMotion>& m, Add&& add) {
    if (!loads_) return;
    for (int lane = 0; lane < kVariantLanes; ++lane) {
      take_motions(m, lane);
      variant_[lane]->external_tangents(t[lane], motions_, [&](int i, int j, const Planar::Mat& dq, const Planar::Mat& dv) { add(lane, i, j, dq, dv); });
    }
  }

  PINTLE_LANES static VariantVec law_force(const BatchJoint& joint, const VariantVec& gap, const VariantVec& rate) {
    VariantVec f;
    for (int k = 0; k < 3; ++k) f[k] = -(joint.k[k] * gap[k] + joint.c[k] * rate[k]);
    return f;
  }

  /// on_bodies += G' f.
  PINTLE_LANES static void add_force(const BatchJoint& joint, const GapMap<VariantLanes>& map, const VariantVec& f, VariantVecs& on_bodies) {
    map.push(f.a.data(), on_bodies[joint.a], on_bodies[joint.b]);
  }
  /// G x.
  PINTLE_LANES static VariantVec gap_change(const BatchJoint& joint, const GapMap<VariantLanes>& map, const VariantVecs& x) {
    VariantVec e;
    map.gather(x[joint.a].a.data(), x[joint.b].a.data(), e.a.data());
    return e;
  }

 private:
  void take_off_target(std::size_t j, const VariantLanes& t, BatchJointKinematics& r) const;
  void take_off_accel(std::size_t j, const VariantLanes& t, VariantVec& bias) const;
  void take_motions(const std::vector<BatchMotion>& m, int lane);
  void add_loads(const VariantLanes& t, const std::vector<BatchMotion>& m, VariantVecs& Q);

  const BlockPattern* pattern_;
  bool loads_;
  std::array<const System*, kVariantLanes> variant_{};
  std::vector<Planar::Motion> motions_;  // of one variant
  Vecs Q_;
};

}  // namespace pintle
