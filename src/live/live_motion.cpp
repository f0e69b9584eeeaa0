// Motion in real time. theory/live section 1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/stopwatch.h"
#include "dynamics/inverse_dynamics.h"
#include "integrators/methods.h"
#include "live/mouse_spring.h"
#include "pintle/live.h"
#include "run/record/force_table.h"
#include "start/start.h"
#include "system/build.h"

namespace pintle {
namespace {

using S = Planar;

constexpr double kTolerance = 1e-4;
constexpr double kFirstStep = 1e-4;       // [s]
constexpr double kStretch = 1.01;         // length of a second attempt, as a multiple of the rest of the frame
constexpr double kPullRate = 9;           // natural frequency of the mechanism on the pull's spring [rad/s]
constexpr double kSoftest = 1e-3;         // upper limit on the pull's stiffness by default, as a fraction of that of the stiffest joint
constexpr double kPullDamping = 0.7;      // as a fraction of critical damping
constexpr std::size_t kMostJoints = 120;  // upper limit for finding effective masses with closed joints

Model as_live(Model model) {
  if (model.bodies.empty()) throw std::invalid_argument("the model has no bodies that could move");
  model.simulate.equations = Equations::kNewtonian;
  if (!(model.simulate.duration > 0)) model.simulate.duration = 1;
  return model;
}

}  // namespace

class LiveMotion::Motion {
 public:
  explicit Motion(const Model& model) : model_(as_live(model)), start_(start_of_run(model_)), state_(start_.state), n_own_(own().joints.size()) {
    if (const double stiffest = largest_stiffness(own()); stiffest > 0) stiffest_ = stiffest;
    restart(kFirstStep);
  }

  void pull(const std::optional<Pull>& pull) {
    if (pull && (pull->body < 0 || pull->body >= own().n_bodies())) throw std::invalid_argument("there is no such body to pull");
    const bool other = pull_ && (!pull || pull_->body != pull->body || pull_->point != pull->point || pull_->stiffness != pull->stiffness);
    if (other) release();
    if (pull && !pull_) hold(*pull);
    pull_ = pull;
  }

  bool advance(double dt, double budget) {
    const Stopwatch clock;
    failure_.clear();
    if (!(dt > 0)) return true;
    if (pull_) lead(dt);
    if (changed_) restart(std::min(last_step_, dt));
    const double end = state_.t + dt, almost = end - 1e-9 * dt;
    while (state_.t < almost) {
      if (!step(end)) return false;
      if (budget > 0 && clock.seconds() > budget) break;
    }
    return true;
  }

  const std::string& failure() const { return failure_; }
  const State& state() const { return state_; }
  std::uint64_t steps() const { return steps_; }
  const std::vector<std::string>& notes() const { return start_.notes; }

  std::vector<JointForce> joint_forces() const {
    std::vector<S::Motion> m;
    system().motions(state_.q, state_.v, m);
    std::vector<JointForce> out;
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const S::Vec load = joint_load(system(), static_cast<int>(j), m, state_.force[j]);
      out.push_back({load[0], load[1], load[2]});
    }
    return out;
  }

  Energies energies() const {
    std::vector<S::Motion> m;
    system().motions(state_.q, state_.v, m);
    Energies out{system().kinetic(state_.v), system().external_work(state_.t, state_.q, m).potential, state_.dissipated, state_.supplied};
    for (std::size_t j = 0; j < n_own_; ++j)
      if (system().joints[j].servo < 0) out.potential += system().joints[j].law.energy(law_point(system(), static_cast<int>(j), state_));
    return out;
  }

 private:
  const System& own() const { return start_.system; }
  const System& system() const { return pulled_ ? *pulled_ : own(); }

  // If no step succeeds the state stays, and the next call tries again from it. A force may have a kink just at the end of the frame: the frame then ends a
  // little later. If a blade snaps through, there may be no continuation at its speed: the motion then continues from rest, and its kinetic energy counts as
  // lost.
  bool step(double end) {
    if (try_step(end)) return true;
    const State before = state_;
    if (try_anew(end)) return true;
    state_.dissipated += system().kinetic(state_.v);
    come_to_rest();
    if (try_anew(end)) return true;
    state_ = before;
    changed_ = true;
    last_step_ = kFirstStep;
    return false;
  }

  bool try_anew(double end) {
    restart(kFirstStep);
    return try_step(state_.t + kStretch * (end - state_.t));
  }

  void come_to_rest() {
    for (Vecs* x : {&state_.v, &state_.gap_rate})
      for (S::Vec& rate : *x) rate.setZero();
  }

  bool try_step(double end) {
    try {
      if (!stepper_->step(end)) {
        failure_ = stepper_->failure();
        return false;
      }
    } catch (const std::exception& error) {
      failure_ = error.what();
      return false;
    }
    if (!is_finite(stepper_->state())) {
      failure_ = fmt::format("the motion has no finite values beyond t = {:.6g} s", state_.t);
      return false;
    }
    failure_.clear();
    ++steps_;
    const double before = state_.t;
    state_ = stepper_->state();
    if (state_.t > before) last_step_ = state_.t - before;
    return true;
  }

  // Starts from the present state, with the present pull.
  void restart(double first_step) {
    balance_start(system(), state_);
    stepper_ = make_stepper(system(), {Equations::kNewtonian, "radau", 3}, kTolerance);
    stepper_->start(state_, std::max(first_step, 1e-9));
    changed_ = false;
  }

  // The pull consists of three joints after the model's own: a spring along x and one along y, each a servo whose target
  // moves with constant speed during a frame, so that no force jumps when the hand moves; and a damper to the world.
  enum { kAlongX, kAlongY, kDamper, kPullJoints };

  void hold(const Pull& pull) {
    const S::Point at = in_world(state_.q[pull.body], pull.point);
    const double mass = mass_at(pull);
    const double k = pull.stiffness > 0 ? pull.stiffness : std::min(kPullRate * kPullRate * mass, kSoftest * stiffest_);
    const double c = 2 * kPullDamping * std::sqrt(k * mass);
    for (int i = 0; i < kPullJoints; ++i) {
      JointData joint = mouse_spring("pull", pull.body, pull.point, 1);
      joint.law = i == kAlongX ? LinearLaw{{k, 0, 0}, {0, 0, 0}} : i == kAlongY ? LinearLaw{{0, k, 0}, {0, 0, 0}} : LinearLaw{{0, 0, 0}, {c, c, 0}};
      if (i < kDamper) {
        joint.servo = joint.driven = i;
        joint.keeps_speed = true;
        joint.start = at[i];
      }
      pull_joints_.push_back(std::move(joint));
    }
    for (Vecs* x : {&state_.gap, &state_.gap_rate, &state_.gap_accel, &state_.force}) x->resize(n_own_ + kPullJoints, S::Vec::Zero());
    take_pull_joints();
  }

  void release() {
    if (!pull_) return;
    pull_.reset();
    for (Vecs* x : {&state_.gap, &state_.gap_rate, &state_.gap_accel, &state_.force}) x->resize(n_own_);
    pull_joints_.clear();
    take_pull_joints();
  }

  // Moves the targets from their present positions to the hand within dt.
  void lead(double dt) {
    bool moved = false;
    for (int i = 0; i < kDamper; ++i) {
      JointData& spring = pull_joints_[i];
      const double now = spring.start + spring.speed * state_.t, speed = (pull_->target[i] - now) / dt;
      if (speed == spring.speed) continue;
      spring.start = now - speed * state_.t;
      spring.speed = speed;
      moved = true;
    }
    if (moved) take_pull_joints();
  }

  // The system changes, so the next step needs a new stepper.
  void take_pull_joints() {
    stepper_.reset();
    changed_ = true;
    pulled_ = pull_joints_.empty() ? nullptr : std::make_unique<const System>(with_joints(own(), pull_joints_));
    std::vector<S::Motion> m;
    system().motions(state_.q, state_.v, m);
    for (std::size_t j = n_own_; j < system().joints.size(); ++j) {
      const JointKinematics r = system().kinematics(static_cast<int>(j), state_.t, m);
      state_.gap[j] = r.gap;
      state_.gap_rate[j] = r.rate;
    }
  }

  // The effective mass at the held point, in the direction in which it moves most easily.
  double mass_at(const Pull& pull) const {
    const double alone = own().bodies[pull.body].mass[0];
    double mass = alone;
    if (n_own_ > kMostJoints) {
      for (const BodyData& each : own().bodies) mass = std::max(mass, each.mass[0]);
    } else {
      const System pinned = with_joints(own(), {mouse_spring("pull", pull.body, pull.point, 1)});
      State there = state_;
      for (Vecs* x : {&there.gap, &there.gap_rate, &there.gap_accel, &there.force}) x->push_back(S::Vec::Zero());
      const EffectiveMasses masses = InverseDynamics(pinned).effective_masses(there);
      if (!masses.closed.empty()) mass = std::min(masses.closed.back()[0], masses.closed.back()[1]);
    }
    return std::isfinite(mass) && mass > 0 ? mass : alone;
  }

  Model model_;
  const Assembly start_;
  std::vector<JointData> pull_joints_;
  std::unique_ptr<const System> pulled_;  // the system with them; null if there is no pull
  State state_;
  std::size_t n_own_ = 0;                 // joints without the pull
  double stiffest_ = 1e300;               // largest stiffness of these [N/m]
  std::unique_ptr<Stepper> stepper_;
  std::optional<Pull> pull_;
  bool changed_ = false;
  double last_step_ = kFirstStep;
  std::uint64_t steps_ = 0;
  std::string failure_;
};

LiveMotion::LiveMotion(const Model& model) : motion_(std::make_unique<Motion>(model)) {}
LiveMotion::~LiveMotion() = default;
LiveMotion::LiveMotion(LiveMotion&&) noexcept = default;
LiveMotion& LiveMotion::operator=(LiveMotion&&) noexcept = default;
void LiveMotion::pull(const std::optional<Pull>& pull) { motion_->pull(pull); }
bool LiveMotion::advance(double dt, double budget) { return motion_->advance(dt, budget); }
const std::string& LiveMotion::failure() const { return motion_->failure(); }
double LiveMotion::time() const { return motion_->state().t; }
std::vector<PlanarPose> LiveMotion::poses() const { return rows(motion_->state().q); }
std::vector<PlanarPose> LiveMotion::velocities() const { return rows(motion_->state().v); }
std::vector<JointForce> LiveMotion::joint_forces() const { return motion_->joint_forces(); }
LiveMotion::Energies LiveMotion::energies() const { return motion_->energies(); }
std::uint64_t LiveMotion::steps() const { return motion_->steps(); }
const std::vector<std::string>& LiveMotion::notes() const { return motion_->notes(); }

}  // namespace pintle
