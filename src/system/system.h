// The mechanism as integrators see it: bodies and joints by index, forces, Jacobians, the pattern of their couplings.
// It knows no files and no integrator. Immutable once it is settled (src/system/build.h makes it from a Model).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "joints/joint_displacement.h"
#include "laws/law.h"
#include "linalg/block_pattern.h"
#include "pintle/expression.h"
#include "system/switching_function.h"

namespace pintle {

using Vecs = std::vector<Planar::Vec>;  // one entry per body, or per joint

constexpr int kGround = -1;

struct BodyData {
  std::string name;
  Planar::Vec mass;     // (m, m, I) [kg, kg, kg*m^2]
  Planar::Vec gravity;  // weight [N, N, N*m]

  double radius_of_gyration() const { return std::sqrt(mass[2] / mass[0]); }  // [m]
};

inline const Planar::Motion kStill{};

/// A body's motion, or that of the ground, which stands still.
inline const Planar::Motion& motion_of(int body, const std::vector<Planar::Motion>& m) {
  return body == kGround ? kStill : m[body];
}

/// A pair of frames on two bodies; kGround is the world.
struct Placement {
  int a = kGround, b = kGround;
  Planar::Frame F, M;
};

/// A gap with a law: a joint of the model, or the servo of a motor (then `target` says what its coordinate follows).
struct JointData {
  std::string name;
  std::string type;
  Placement at;
  JointDisplacement displacement;
  Law law;
  bool ideal = false;          // its gap is kept at zero by the equations, its law is not asked
  std::array<bool, 3> redundant{};  // components of an ideal joint that other ideal joints keep already
  int servo = -1;              // component that a servo drives, -1: not a servo
  bool keeps_speed = false;    // servo of a constant speed
  double start = 0;            // constant-speed servo: coordinate as assembled
  double speed = 0;            // constant-speed servo [rad/s or m/s]
  Expression target;           // servo that follows a function of t; the coordinate is start + speed t + target(t)
  Planar::Vec free_mask = Planar::Vec::Zero();  // 1 in components that are free coordinates
  std::array<bool, 3> held{};  // components that the joint forbids
  int first_state = 0;         // of the law, among those of all joints
};

/// What a servo's coordinate is to be at time t, with its rate and acceleration.
std::array<double, 3> servo_target(const JointData& joint, double t);

/// What an effort motor's expression reads: the time, or a coordinate (or rate) of a joint.
struct Signal {
  int joint = -1;  // -1: the time
  int component = 0;
  bool rate = false;
};

enum class LoadKind { kSpring, kTorsionSpring, kEffort };

/// A force along one coordinate between two bodies that is not a joint's: springs, dampers, motors with a torque law.
struct LoadData {
  std::string name;
  LoadKind kind = LoadKind::kSpring;
  Placement at;
  int component = 0;     // of z: torsion springs 2; motors 2 or 0
  double k = 0, c = 0;   // [N/m, N*s/m] or [N*m/rad, N*m*s/rad]
  double free = 0;       // length or angle without elastic force
  double constant = 0;   // a spring without stiffness: its preload at any length [N] or [N*m]
  Expression law;        // motors: effort on the second body
  std::vector<Signal> signals;
};

/// A motor's effort kept at one of its jumps: on a ramp between the efforts of both sides.
struct SlidingMode {
  int load = 0;
  Expression::Ramp ramp;
};
using SlidingModes = std::span<const SlidingMode>;

/// A force on one body at a point, functions of t.
struct AppliedData {
  std::string name;
  int body = 0;
  Planar::Frame at;
  Expression fx, fy, torque;
  bool body_axes = false;
};

/// G x: what the bodies' rates, accelerations or small displacements x make of a gap.
inline Planar::Vec gap_change(const Placement& at, const JointKinematics& r, const Vecs& x) {
  constexpr double still[3] = {0, 0, 0};
  Planar::Vec e;
  r.map.gather(at.a != kGround ? x[at.a].data() : still, at.b != kGround ? x[at.b].data() : still, e.data());
  return e;
}
/// gap += G x.
inline void add_gap(const Placement& at, const JointKinematics& r, const Vecs& x, Planar::Vec& gap) { gap += gap_change(at, r, x); }
/// gap -= G x.
inline void subtract_gap(const Placement& at, const JointKinematics& r, const Vecs& x, Planar::Vec& gap) { gap -= gap_change(at, r, x); }
/// on_bodies += G' f: a gap's force as forces on its bodies.
inline void add_force(const Placement& at, const JointKinematics& r, const Planar::Vec& f, Vecs& on_bodies) {
  const auto on = r.map.spread(f.data());
  if (at.a != kGround) on_bodies[at.a] += Planar::Vec(-on.fx, -on.fy, on.ma);
  if (at.b != kGround) on_bodies[at.b] += Planar::Vec(on.fx, on.fy, on.mb);
}

/// Forces that are not a joint's, and their energy bookkeeping.
struct ExternalWork {
  double potential = 0;  // gravity and springs [J]
  double supplied = 0;   // power of motors and applied forces [W]
  double lost = 0;       // power lost in dampers [W]
};

class System {
 public:
  using S = Planar;
  static constexpr int kDof = S::kDof;
  using Vec = S::Vec;
  using Mat = S::Mat;

  std::vector<BodyData> bodies;
  std::vector<JointData> joints;
  std::vector<LoadData> loads;
  std::vector<AppliedData> applied;

  int n_bodies() const { return static_cast<int>(bodies.size()); }
  int n_joints() const { return static_cast<int>(joints.size()); }
  /// Whether anything but weight and joints acts.
  bool has_loads() const { return !loads.empty() || !applied.empty(); }
  const BlockPattern& pattern() const { return *pattern_; }
  /// Fixes the pattern; call when bodies, joints and loads are complete. Variants of one mechanism share that of `like`.
  void finish(const System* like = nullptr);

  /// Where the bodies are and how they move.
  void motions(const Vecs& q, const Vecs& v, std::vector<S::Motion>& out) const;
  /// The relative pose of a placement.
  RelativePose pose(const Placement& at, const std::vector<S::Motion>& m) const {
    return RelativePose::between(motion_of(at.a, m), at.F, motion_of(at.b, m), at.M);
  }
  /// Gap, rate, Jacobians and convective term of joint j at time t (a servo's target taken off).
  JointKinematics kinematics(int j, double t, const std::vector<S::Motion>& m) const;
  void joint_kinematics(double t, const std::vector<S::Motion>& m, std::vector<JointKinematics>& out) const;
  /// Gravity, springs, applied forces and effort motors: the generalised force on every body. Motors in `sliding` stand at a jump.
  void external(double t, const std::vector<S::Motion>& m, Vecs& Q, SlidingModes sliding = {}) const;
  ExternalWork external_work(double t, const Vecs& q, const std::vector<S::Motion>& m, SlidingModes sliding = {}) const;
  /// Force (spring: tension; motor: effort) of a load.
  double load_effort(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding = {}) const;

  /// The borders, kinks and jumps of all laws, loads and servos.
  const std::vector<SwitchingFunction>& switching() const { return switching_; }
  bool has_branches() const { return !switching_.empty(); }
  /// The value of each. Gaps and rates are the joints'.
  void find_switching(double t, const std::vector<S::Motion>& m, const Vecs& gap, const Vecs& rate, const std::vector<double>& law_state,
                      SlidingModes sliding, double* value) const;
  /// What it is, for messages: border 1 of "tension" in joint R.
  std::string name(const SwitchingFunction& function) const;
  /// A jump of a motor's effort between two instants, as a ramp still to be given its share.
  std::optional<SlidingMode> jump_between(double t0, const std::vector<S::Motion>& m0, double t1, const std::vector<S::Motion>& m1) const;
  /// How far the argument of a jump is above it.
  double margin(const SlidingMode& jump, double t, const std::vector<S::Motion>& m) const;

  /// Calls add(i, j, dQ_i/dq_j, dQ_i/dv_j) for every block of the external forces' tangents.
  template <class Add>
  void external_tangents(double t, const std::vector<S::Motion>& m, Add&& add, SlidingModes sliding = {}) const;

  /// M a = Q + G' law(gap, rate): the equations of motion as they stand (for explicit methods and tests), and the rates of the laws' own
  /// states; both lists of states may be left out where no law has any.
  void accelerations(double t, const Vecs& q, const Vecs& v, Vecs& a, const double* law_state = nullptr, double* law_rate = nullptr) const;

  /// States of all joints' laws together.
  int n_law_states() const { return n_law_states_; }

  /// Kinetic energy [J].
  double kinetic(const Vecs& v) const;
  /// The largest speed of a body's centre or of a point at its radius of gyration about it [m/s].
  double largest_speed(const Vecs& v) const;
  double largest_radius_of_gyration() const;  // [m]

 private:
  void list_switching();

  struct LoadState;
  LoadState load_state(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding) const;
  const Expression::Ramp* ramp_of(const LoadData& load, SlidingModes sliding) const;
  struct Tangent {
    int i, j;
    Mat dq, dv;
  };
  void load_tangents(const LoadData& load, double t, const std::vector<S::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const;
  void applied_tangents(const AppliedData& force, double t, const std::vector<S::Motion>& m, std::vector<Tangent>& out) const;

  std::vector<std::pair<int, int>> coupled_;  // bodies
  std::shared_ptr<const BlockPattern> pattern_ = std::make_shared<const BlockPattern>();
  std::vector<SwitchingFunction> switching_;
  int n_law_states_ = 0;
  mutable std::vector<Tangent> tangents_;  // reused so that steps do not allocate
};

template <class Add>
void System::external_tangents(double t, const std::vector<S::Motion>& m, Add&& add, SlidingModes sliding) const {
  for (const LoadData& load : loads) {
    tangents_.clear();
    load_tangents(load, t, m, sliding, tangents_);
    for (const Tangent& k : tangents_) add(k.i, k.j, k.dq, k.dv);
  }
  for (const AppliedData& force : applied) {
    tangents_.clear();
    applied_tangents(force, t, m, tangents_);
    for (const Tangent& k : tangents_) add(k.i, k.j, k.dq, k.dv);
  }
}

}  // namespace pintle
