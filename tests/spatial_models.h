// Mechanisms in space for tests and benchmarks, with the sources of their figures: a heavy top, Bricard's six hinges, a free chain, and a planar mechanism put
// into space.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "start/start.h"
#include "system/build.h"

namespace pintle::sample {

using SpatialSystem = BasicSystem<Spatial>;
using SpatialState = BasicState<Spatial>;

/// Principal moments of inertia [kg*m^2]; gravity [m/s^2].
inline BasicBodyData<Spatial> spatial_body(const std::string& name, double mass, const Spatial::Point& inertia, const Spatial::Point& gravity) {
  BasicBodyData<Spatial> b;
  b.name = name;
  b.mass << mass, mass, mass, inertia;
  b.gravity << mass * gravity, 0, 0, 0;
  return b;
}

/// What a joint resists with: stiffness and damping of the positions [N/m, N*s/m], and of a hinge's tilts [N*m/rad, N*m*s/rad].
struct SpatialStiffness {
  double k = 0, c = 0, k_turn = 0, c_turn = 0;
};

/// "spherical" or "revolute".
inline BasicJointData<Spatial> spatial_joint(const std::string& name, const std::string& type, int a, const Spatial::Frame& F, int b, const Spatial::Frame& M, const SpatialStiffness& holds) {
  BasicJointData<Spatial> j;
  j.name = name;
  j.type = type;
  j.at = {a, b, F, M};
  BasicLinearLaw<Spatial> law;
  const bool hinge = type == "revolute";
  for (int i = 0; i < Spatial::kDof; ++i) {
    const bool held = i < Spatial::kDim || (hinge && i != Spatial::kTurn);
    j.held[i] = held;
    j.free_mask[i] = held ? 0 : 1;
    if (!held) continue;
    law.k[i] = i < Spatial::kDim ? holds.k : holds.k_turn;
    law.c[i] = i < Spatial::kDim ? holds.c : holds.c_turn;
  }
  j.law = law;
  return j;
}

/// A mechanism and its start.
struct SpatialSample {
  SpatialSystem system;
  SpatialState start;
  std::vector<std::string> notes;  // on the start

  /// The start from these positions and velocities with the joints loaded; `duration` [s] above 0: on their slow motion.
  void start_at(const PositionsOf<Spatial>& q, const VecsOf<Spatial>& v, double duration = 0) {
    BasicSettledStart<Spatial> settled;
    settled.state.q = q;
    settled.state.v = v;
    start_forces(system, true, settled.state);
    if (duration > 0) settle_joints(system, duration, 0, settled);
    start = settled.state;
    notes = settled.notes;
  }
};

/// Z. Terze, A. Mueller, D. Zlatar, Multibody System Dynamics 38 (2016) 201-225, with a spherical joint: 15 kg, 150 rad/s.
inline SpatialSample heavy_top(double duration = 0) {
  SpatialSample top;
  top.system.bodies.push_back(spatial_body("top", 15, {0.234375, 0.46875, 0.234375}, {0, 0, -9.81}));
  top.system.joints.push_back(spatial_joint("ball", "spherical", kGround, Spatial::Frame{}, 0, Spatial::Frame::at({0, -1, 0}, Eigen::Matrix3d::Identity()), {1e9, 1e4}));
  top.system.finish();
  Spatial::Vec v;
  v << 4.61538, 0, 0, 0, 150, -4.61538;
  top.start_at({Spatial::Coordinates{{0, 1, 0}, Eigen::Quaterniond::Identity()}}, {v}, duration);
  return top;
}

/// IFToMM library of benchmark problems, A04: Bricard's mechanism, six hinges in a ring of five rods of 1 m and 1 kg, with one redundant constraint; from rest.
/// Hinges of k [N/m], a tenth of it in the tilts.
inline SpatialSample bricard(double k) {
  using Point = Spatial::Point;
  SpatialSample ring;
  const std::vector<Point> P{{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
  const std::vector<Point> axis{Point::UnitY(), Point::UnitZ(), Point::UnitX(), Point::UnitY(), Point::UnitZ(), Point::UnitX()};
  PositionsOf<Spatial> q;
  for (int i = 0; i < 5; ++i) {
    const Point along = P[i + 1] - P[i];
    Point inertia = Point::Constant(0.08416666666666667);
    inertia += (0.0016666666666666668 - inertia[0]) * along.cwiseAbs();
    ring.system.bodies.push_back(spatial_body("rod" + std::to_string(i + 1), 1, inertia, {0, -9.81, 0}));
    q.push_back({0.5 * (P[i] + P[i + 1]), Eigen::Quaterniond::Identity()});
  }
  for (int j = 0; j < 6; ++j) {
    const int a = j == 0 ? kGround : j - 1, b = j == 5 ? kGround : j;
    const auto frame = [&](int on) { return Spatial::Frame::along(on == kGround ? P[j] : Point(P[j] - q[on].p), axis[j]); };
    ring.system.joints.push_back(spatial_joint("P" + std::to_string(j), "revolute", a, frame(a), b, frame(b), {k, 1e-4 * k, 0.1 * k, 1e-5 * k}));
  }
  ring.system.finish();
  ring.start_at(q, VecsOf<Spatial>(5, Spatial::Vec::Zero()), 10);
  return ring;
}
/// P3 of the ring, the joint of its third and fourth rod [m].
inline Spatial::Point bricard_p3(const Spatial::Coordinates& third) { return third.p + third.r * Spatial::Point(0, 0, 0.5); }

/// Rods of 0.5 m and 1 kg on spherical joints, one after the other at right angles, joined to nothing else; thrown and spinning as one rigid body.
inline SpatialSample free_chain(int rods, double k) {
  using Point = Spatial::Point;
  constexpr double half = 0.25;
  SpatialSample chain;
  PositionsOf<Spatial> q;
  VecsOf<Spatial> v;
  const Point throw_speed(0.3, -0.2, 0.1), spin(2, 1, 3);
  Point end = Point::Zero();
  for (int i = 0; i < rods; ++i) {
    const Point along = Point::Unit(i % 3);
    Point inertia = Point::Constant(1.0 / 48);
    inertia[i % 3] = 1e-3;
    chain.system.bodies.push_back(spatial_body("rod" + std::to_string(i + 1), 1, inertia, Point::Zero()));
    const Point centre = end + half * along;
    q.push_back({centre, Eigen::Quaterniond::Identity()});
    v.emplace_back();
    v.back() << throw_speed + spin.cross(centre), spin;
    if (i > 0)
      chain.system.joints.push_back(spatial_joint("ball" + std::to_string(i), "spherical", i - 1, Spatial::Frame::at(end - q[i - 1].p, Eigen::Matrix3d::Identity()), i,
                                                  Spatial::Frame::at(end - centre, Eigen::Matrix3d::Identity()), {k, 1e-4 * k}));
    end += 2 * half * along;
  }
  chain.system.finish();
  chain.start_at(q, v, 2);
  return chain;
}

/// Where the components of the plane are in space: x, y and the turn about z.
inline constexpr std::array<int, Planar::kDof> kInSpace{0, 1, Spatial::kTurn};
inline Spatial::Vec in_space(const Planar::Vec& x) {
  Spatial::Vec y = Spatial::Vec::Zero();
  for (int k = 0; k < Planar::kDof; ++k) y[kInSpace[k]] = x[k];
  return y;
}
inline Spatial::Frame in_space(const Planar::Frame& F) { return Spatial::Frame::at({F.p.x(), F.p.y(), 0}, Eigen::AngleAxisd(F.angle, Spatial::Point::UnitZ()).toRotationMatrix()); }

/// A planar system of hinges as one in space, with z axes out of the plane and hinges that hold their tilts.
inline SpatialSystem in_space(const System& planar) {
  SpatialSystem system;
  for (const BodyData& b : planar.bodies)
    system.bodies.push_back(spatial_body(b.name, b.mass[0], Spatial::Point(0.4, 0.7, 1) * b.mass[2], {b.gravity[0] / b.mass[0], b.gravity[1] / b.mass[0], 0}));
  for (const JointData& j : planar.joints) {
    const LinearLaw& law = *j.law.as_linear();
    system.joints.push_back(spatial_joint(j.name, "revolute", j.at.a, in_space(j.at.F), j.at.b, in_space(j.at.M), {law.k[0], law.c[0], law.k[0], law.c[0]}));
  }
  system.finish();
  return system;
}
/// A state of the planar system as one of `system`.
inline SpatialState in_space(const SpatialSystem& system, const State& planar) {
  SpatialState state;
  for (const Planar::Vec& q : planar.q) state.q.push_back({{q[0], q[1], 0}, Eigen::Quaterniond(Eigen::AngleAxisd(q[2], Spatial::Point::UnitZ()))});
  for (const Planar::Vec& v : planar.v) state.v.push_back(in_space(v));
  start_forces(system, false, state);
  const auto put = [](const Vecs& from, VecsOf<Spatial>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = in_space(from[i]);
  };
  put(planar.gap, state.gap);
  put(planar.gap_rate, state.gap_rate);
  put(planar.gap_accel, state.gap_accel);
  put(planar.force, state.force);
  put(planar.a, state.a);
  return state;
}

}  // namespace pintle::sample
