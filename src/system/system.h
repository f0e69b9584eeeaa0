// The mechanism as seen by integrators: bodies and joints by index, forces, Jacobians, the pattern of their couplings.
// It knows neither files nor integrators. Immutable once it is complete (src/system/build.h makes it from a Model).
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

template <class S>
using VecsOf = std::vector<typename S::Vec>;  // one entry per body, or per joint
using Vecs = VecsOf<Planar>;
template <class S>
using PositionsOf = std::vector<typename S::Coordinates>;  // one per body

constexpr int kGround = -1;

template <class S>
struct BasicBodyData {
  std::string name;
  typename S::Vec mass;     // (m, m, I) [kg, kg, kg*m^2]
  typename S::Vec gravity;  // weight [N, N, N*m]

  /// About the axis with the largest inertia [m].
  double radius_of_gyration() const { return std::sqrt(mass.template tail<S::kDof - S::kDim>().maxCoeff() / mass[0]); }
};
using BodyData = BasicBodyData<Planar>;

template <class Motion>
inline const Motion kStill{};

/// Motion of a body, or of the ground, which is at rest.
template <class Motion>
const Motion& motion_of(int body, const std::vector<Motion>& m) {
  return body == kGround ? kStill<Motion> : m[body];
}

/// A pair of frames on two bodies; kGround is the world.
template <class S>
struct BasicPlacement {
  int a = kGround, b = kGround;
  typename S::Frame F, M;
};
using Placement = BasicPlacement<Planar>;

class SpeedIntegral;

/// A gap with a law: a joint of the model, or the servo of a motor.
template <class S>
struct BasicJointData {
  std::string name;
  std::string type;
  BasicPlacement<S> at;
  BasicDisplacement<S> displacement;
  std::shared_ptr<const CamProfile> cam{};    // read by the displacement of a cam
  std::shared_ptr<const EdgeProfile> edge{};  // read by that of an edge
  BasicLaw<S> law;
  bool ideal = false;          // its gap is kept at zero by the equations, its law is not evaluated
  bool opened = false;         // the model calls it ideal, but the tree of relative coordinates cannot keep its gap at zero: its law acts
  bool constrained = false;    // an ideal joint in constraint equations: a start finds no deflection for it
  std::array<bool, S::kDof> redundant{};  // components of an ideal joint that other ideal joints constrain already
  int servo = -1;              // component driven by a servo, -1: not a servo
  int driven = -1;             // component whose gap is its deviation from `target`: a servo's, or the length of a rod or rope; -1: none
  bool keeps_speed = false;    // servo that follows a speed
  double start = 0;            // for such a servo: coordinate as assembled
  double speed = 0;            // constant-speed servo [rad/s or m/s]
  Expression target;           // a driven component follows start + speed t + target(t)
  std::shared_ptr<const SpeedIntegral> speed_integral{};  // for a servo whose speed is `target`: it follows start + speed_integral
  typename S::Vec free_mask = S::Vec::Zero();  // 1 in components that are free coordinates
  std::array<bool, S::kDof> held{};  // components forbidden by the joint
  int first_state = 0;         // index of the law's first state among those of all joints
};
using JointData = BasicJointData<Planar>;

/// Target of a driven component at time t, with its rate and acceleration.
template <class S>
std::array<double, 3> target_of(const BasicJointData<S>& joint, double t);

/// An input of an effort's expression: the time, or a component of the relative pose of two frames (or its rate). The frames are those of a
/// joint, or the ground's and one on a body.
template <class S>
struct BasicSignal {
  bool is_time = true;
  BasicPlacement<S> at;
  int component = 0;
  bool rate = false;
};
using Signal = BasicSignal<Planar>;

enum class LoadKind { kSpring, kTorsionSpring, kEffort };

/// A force along one coordinate between two bodies that does not belong to a joint: springs, dampers, motors with a torque law.
template <class S>
struct BasicLoadData {
  std::string name;
  LoadKind kind = LoadKind::kSpring;
  BasicPlacement<S> at;
  int component = 0;     // of z: the turn for torsion springs; the turn or the slide for motors
  double k = 0, c = 0;   // [N/m, N*s/m] or [N*m/rad, N*m*s/rad]
  double free = 0;       // length or angle at which the elastic force is zero
  double constant = 0;   // for a spring without stiffness: its preload at any length [N] or [N*m]
  Expression law;        // motors: effort on the second body
  std::vector<BasicSignal<S>> signals;
  bool applied = false;  // an effort that is an applied force along a component, not a motor's
};
using LoadData = BasicLoadData<Planar>;

/// Limit on the signals that an expression may read.
inline constexpr int kMaxSignals = 16;

/// A motor's effort held at one of its jumps: on a ramp between the efforts on both sides.
struct SlidingMode {
  int load = 0;
  Expression::Ramp ramp;
};
using SlidingModes = std::span<const SlidingMode>;

/// A force on one body at a point, given by functions of t.
template <class S>
struct BasicAppliedData;
template <>
struct BasicAppliedData<Planar> {
  std::string name;
  int body = 0;
  Planar::Frame at;
  Expression fx, fy, torque;
  bool body_axes = false;

  std::array<const Expression*, 3> functions() const { return {&fx, &fy, &torque}; }
};
template <>
struct BasicAppliedData<Spatial> {
  std::string name;
  int body = 0;
  Spatial::Frame at;
  std::array<Expression, 3> force, torque;
  bool body_axes = false;  // otherwise in world axes

  std::array<const Expression*, 6> functions() const { return {&force[0], &force[1], &force[2], &torque[0], &torque[1], &torque[2]}; }
};
using AppliedData = BasicAppliedData<Planar>;

/// G x: change of a gap due to the bodies' rates, accelerations or small displacements x.
template <class S>
inline typename S::Vec gap_change(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r, const VecsOf<S>& x) {
  constexpr double still[S::kDof] = {};
  typename S::Vec e;
  r.map.gather(at.a != kGround ? x[at.a].data() : still, at.b != kGround ? x[at.b].data() : still, e.data());
  return e;
}
/// gap += G x.
template <class S>
inline void add_gap(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r, const VecsOf<S>& x, typename S::Vec& gap) { gap += gap_change(at, r, x); }
/// gap -= G x.
template <class S>
inline void subtract_gap(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r, const VecsOf<S>& x, typename S::Vec& gap) { gap -= gap_change(at, r, x); }
/// on_bodies += G' f: a gap's force as forces on its bodies.
template <class S>
inline void add_force(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r, const typename S::Vec& f, VecsOf<S>& on_bodies) {
  typename S::Vec on_ground = S::Vec::Zero();
  r.map.push(f.data(), at.a != kGround ? on_bodies[at.a] : on_ground, at.b != kGround ? on_bodies[at.b] : on_ground);
}

/// The moment -w x I w of a spinning body, in its axes, and its derivative by the velocity. theory/space Eq. (4.2).
Spatial::Vec gyroscopic_force(const BasicBodyData<Spatial>& body, const Spatial::Motion& m);
Spatial::Mat gyroscopic_tangent(const BasicBodyData<Spatial>& body, const Spatial::Motion& m);

/// Energy bookkeeping of the forces that do not belong to joints.
struct ExternalWork {
  double potential = 0;  // gravity and springs [J]
  double supplied = 0;   // power of motors and applied forces [W]
  double lost = 0;       // power lost in dampers [W]
};

template <class S>
class BasicSystem {
 public:
  static constexpr int kDof = S::kDof;
  using Vec = typename S::Vec;
  using Mat = typename S::Mat;

  std::vector<BasicBodyData<S>> bodies;
  std::vector<BasicJointData<S>> joints;
  std::vector<BasicLoadData<S>> loads;
  std::vector<BasicAppliedData<S>> applied;

  int n_bodies() const { return static_cast<int>(bodies.size()); }
  int n_joints() const { return static_cast<int>(joints.size()); }
  /// Whether anything acts apart from weight and joints; in space, moments of spinning bodies always do.
  bool has_loads() const { return S::kGyroscopic || !loads.empty() || !applied.empty(); }
  const BlockPattern& pattern() const { return *pattern_; }
  /// Fixes the pattern; to be called when bodies, joints and loads are complete. Variants of one mechanism share the pattern of `like`.
  void finish(const BasicSystem* like = nullptr);

  /// Positions and motions of the bodies.
  void motions(const PositionsOf<S>& q, const VecsOf<S>& v, std::vector<typename S::Motion>& out) const;
  /// The relative pose of a placement.
  typename S::RelativePose pose(const BasicPlacement<S>& at, const std::vector<typename S::Motion>& m) const {
    return S::RelativePose::between(motion_of(at.a, m), at.F, motion_of(at.b, m), at.M);
  }
  /// Gap, rate, Jacobians and convective term of joint j at time t (with the target of a driven component subtracted).
  BasicJointKinematics<S> kinematics(int j, double t, const std::vector<typename S::Motion>& m) const;
  void joint_kinematics(double t, const std::vector<typename S::Motion>& m, std::vector<BasicJointKinematics<S>>& out) const;
  /// Mobility of a joint with only its own two bodies: the acceleration of its gap per unit of force, component by component [1/kg], [1/(kg*m^2)].
  Vec own_mobility(const BasicPlacement<S>& at, const BasicJointKinematics<S>& r) const;
  /// Power that the drive of a joint delivers at this force, 0 without a drive [W]: a servo's in its coordinate, that of a change of length of a rod or rope, that of the fluid in a cylinder.
  double drive_power(const BasicJointData<S>& joint, double t, const std::vector<typename S::Motion>& m, const Vec& force) const;
  /// Gravity, springs, applied forces and effort motors: the generalised force on every body. Motors in `sliding` are held at a jump.
  void external(double t, const std::vector<typename S::Motion>& m, VecsOf<S>& Q, SlidingModes sliding = {}) const;
  ExternalWork external_work(double t, const PositionsOf<S>& q, const std::vector<typename S::Motion>& m, SlidingModes sliding = {}) const;
  /// The contribution of one load to it, and the power of one applied force [W].
  ExternalWork work_of(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding = {}) const;
  double power_of(const BasicAppliedData<S>& force, double t, const std::vector<typename S::Motion>& m) const;
  /// The values that the expression of an effort reads, in the order of its signals.
  std::array<double, kMaxSignals> signal_values(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m) const;
  /// Force (spring: tension; motor: effort) of a load.
  double load_effort(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding = {}) const;

  /// The borders, kinks and jumps of all laws, loads and servos.
  const std::vector<SwitchingFunction>& switching_functions() const { return switching_; }
  bool has_branches() const { return !switching_.empty(); }
  /// The value of each. Gaps and rates are the joints'.
  void evaluate_switching_functions(double t, const std::vector<typename S::Motion>& m, const VecsOf<S>& gap, const VecsOf<S>& rate, const std::vector<double>& law_state,
                                    SlidingModes sliding, double* value) const;
  /// Where the switching functions had the values `before` and have the values `after`: the laws whose borders were crossed set their states,
  /// LawPart::cross. Returns whether there are any; stored energy that is lost in this way is added to `lost` [J].
  bool cross_borders(double t, const VecsOf<S>& gap, const VecsOf<S>& rate, const double* before, const double* after, std::vector<double>& law_state, double& lost) const;
  /// Name for messages: border 1 of "tension" in joint R.
  std::string name(const SwitchingFunction& function) const;
  /// A jump of a motor's effort between two instants, as a ramp whose share is still to be set.
  std::optional<SlidingMode> jump_between(double t0, const std::vector<typename S::Motion>& m0, double t1, const std::vector<typename S::Motion>& m1) const;
  /// By how much the argument of a jump exceeds its threshold.
  double margin(const SlidingMode& jump, double t, const std::vector<typename S::Motion>& m) const;

  /// Calls add(i, j, dQ_i/dq_j, dQ_i/dv_j) for every block of the external forces' tangents.
  template <class Add>
  void external_tangents(double t, const std::vector<typename S::Motion>& m, Add&& add, SlidingModes sliding = {}) const;

  /// M a = Q + G' law(gap, rate): the equations of motion without transformation (for explicit methods and tests), and the rates of the
  /// laws' own states. Both lists of states may be omitted if no law has any.
  void accelerations(double t, const PositionsOf<S>& q, const VecsOf<S>& v, VecsOf<S>& a, const double* law_state = nullptr, double* law_rate = nullptr) const;

  /// Number of states of all joints' laws together.
  int n_law_states() const { return n_law_states_; }

  /// Kinetic energy [J].
  double kinetic(const VecsOf<S>& v) const;
  /// The largest speed of a body's centre or of a point at the radius of gyration from it [m/s].
  double largest_speed(const VecsOf<S>& v) const;
  double largest_radius_of_gyration() const;  // [m]

 private:
  void list_switching();

  struct LoadState {
    BasicDisplacement<S> displacement;
    typename S::RelativePose pose;
    BasicJointKinematics<S> kinematics;
    double effort = 0;  // force along the component [N] or [N*m]; negative for a spring in tension
    int slot = 0;       // component of the displacement
    double df_dgap = 0, df_drate = 0;
    std::array<double, kMaxSignals> df_dsignal{};
  };
  LoadState load_state(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding) const;
  const Expression::Ramp* ramp_of(const BasicLoadData<S>& load, SlidingModes sliding) const;
  struct Tangent {
    int i, j;
    Mat dq, dv;
  };
  void load_tangents(const BasicLoadData<S>& load, double t, const std::vector<typename S::Motion>& m, SlidingModes sliding, std::vector<Tangent>& out) const;
  void applied_tangents(const BasicAppliedData<S>& force, double t, const std::vector<typename S::Motion>& m, std::vector<Tangent>& out) const;

  std::vector<std::pair<int, int>> coupled_;  // bodies
  std::shared_ptr<const BlockPattern> pattern_ = std::make_shared<const BlockPattern>();
  std::vector<SwitchingFunction> switching_;
  int n_law_states_ = 0;
  mutable std::vector<Tangent> tangents_;  // reused to avoid allocations in steps
};

template <class S>
template <class Add>
void BasicSystem<S>::external_tangents(double t, const std::vector<typename S::Motion>& m, Add&& add, SlidingModes sliding) const {
  for (const BasicLoadData<S>& load : loads) {
    tangents_.clear();
    load_tangents(load, t, m, sliding, tangents_);
    for (const Tangent& k : tangents_) add(k.i, k.j, k.dq, k.dv);
  }
  for (const BasicAppliedData<S>& force : applied) {
    tangents_.clear();
    applied_tangents(force, t, m, tangents_);
    for (const Tangent& k : tangents_) add(k.i, k.j, k.dq, k.dv);
  }
  if constexpr (S::kGyroscopic)
    for (int i = 0; i < n_bodies(); ++i) add(i, i, Mat(Mat::Zero()), gyroscopic_tangent(bodies[i], m[i]));
}
using System = BasicSystem<Planar>;

}  // namespace pintle
