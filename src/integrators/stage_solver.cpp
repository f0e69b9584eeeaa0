// Simplified Newton on all stages at once: they stand side by side in the lanes of Lanes<N>, and so do the real and complex
// systems into which their equations fall apart.
#include "integrators/lane_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/pose_blocks.h"
#include "solve/wide.h"

namespace pintle {

using S = Planar;

template <int N>
LaneSolver<N>::LaneSolver(const System& system, const RadauTable& table, double tolerance, Steps steps)
    : system_(system), table_(table), matrices_(table), tolerance_(tolerance), steps_(steps), loads_(system.has_loads()),
      bodies_(system.bodies.size() + 1), joints_(system.joints.size()), Q_(system.bodies.size()), motions_(system.bodies.size()), slots_(system.joints.size()),
      lu_(system.pattern(), loads_ ? Symmetry::kNone : symmetry_of_joints(system)), rhs_(system.bodies.size() + 1) {
  bodies_.back().c = L::all(1);  // the ground; what falls on it is not looked at
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].Q[k] = L::all(system.bodies[b].gravity[k]);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointData& joint = system.joints[j];
    joints_[j].map.function = !std::holds_alternative<Selection>(joint.probe);
    joints_[j].diagonal = std::holds_alternative<LinearLaw>(joint.law);
    simple_ = simple_ && joints_[j].diagonal && joint.servo < 0;
    if (joint.at.a != kGround && joint.at.b != kGround) slots_[j] = system.pattern().slot(joint.at.a, joint.at.b);
  }
}

template <int N>
bool LaneSolver<N>::solve_stages(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale,
                                 Counters& counters) {
  step_.scale(matrices_, h);
  take_scale(scale);
  predict(begin, h, before, last_h);
  find_targets(begin.t, h);
  place_bodies(begin);
  place_joints(begin);
  contraction_.start();
  bool fresh = h != factorized_for_ || contraction_.rate() > kGood, wanted = fresh;  // a factorisation
  for (int iteration = 0; iteration < NewtonContraction::kMaxIterations; ++iteration) {
    find_residuals(begin, h);
    counters.evaluations += N;
    if (wanted) {
      if (!renew(begin, h, counters)) return false;
      wanted = false;
    }
    const double correction = correct(begin);
    ++counters.newton_iterations;
    const auto verdict = contraction_.judge(iteration, correction, tolerance_);
    if (verdict == NewtonContraction::Verdict::kDone) return true;
    const bool hopeless = verdict == NewtonContraction::Verdict::kHopeless;
    if (hopeless && fresh) return false;
    if (hopeless || (!fresh && iteration > 0 && (contraction_.rate() > kSlow || iteration > kMostWithOld))) {
      fresh = wanted = true;
      contraction_.start();
      iteration = -1;
    }
  }
  return false;
}

// What corrections are measured by.
template <int N>
void LaneSolver<N>::take_scale(const LoadScale& scale) {
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].over_scale[k] = system_.bodies[b].mass[k] / scale.body[b][k];
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Placement& at = system_.joints[j].at;
    const S::Vec& on = scale.body[at.a == kGround ? at.b : at.a];
    const S::Vec& beside = scale.body[at.b == kGround ? at.a : at.b];
    for (int k = 0; k < 3; ++k) joints_[j].over_scale[k] = 1 / std::max(on[k], beside[k]);
  }
}

// Jacobians of this step, factorised.
template <int N>
bool LaneSolver<N>::renew(const State& begin, double h, Counters& counters) {
  linearize(begin.t + table_.c[kMiddle] * h, begin.held);
  counters.factorizations += 1 + N / 2;
  factorized_for_ = factorize(h) ? h : 0;
  return factorized_for_ != 0;
}

template <int N>
void LaneSolver<N>::predict(const State& begin, double h, const StepNodes* before, double last_h) {
  std::array<L, RadauTable::kMaxNodes> weight;
  if (before)
    for (int s = 0; s < N; ++s) {
      const double ratio = h / last_h;
      const RadauTable::Vec w = steps_ == Steps::kLong ? table_.continuation(table_.c[s], ratio) : table_.weights(1 + table_.c[s] * ratio);
      for (int k = 0; k <= N; ++k) weight[k].set(s, w[k]);
    }
  const auto continued = [&](std::size_t i, int k, const std::vector<Vecs>& nodes, const Vecs& start) {
    if (!before) return L::all(start[i][k]);
    L x = nodes[0][i][k] * weight[0];
    for (int node = 1; node <= N; ++node) x += nodes[node][i][k] * weight[node];
    return x;
  };
  static const std::vector<Vecs> kNone;
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].a[k] = continued(b, k, before ? before->a : kNone, begin.a);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (int k = 0; k < 3; ++k) joints_[j].accel[k] = continued(j, k, before ? before->gap_accel : kNone, begin.gap_accel);
}

// The accelerations that servos are to follow.
template <int N>
void LaneSolver<N>::find_targets(double t, double h) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointData& joint = system_.joints[j];
    if (joint.servo < 0 || joint.target.variables().empty()) continue;
    for (int s = 0; s < N; ++s) joints_[j].target_accel.set(s, servo_target(joint, t + table_.c[s] * h)[2]);
  }
}

// Where the stages are, from their accelerations. Eq. (3.5).
template <int N>
Lanes<N> LaneSolver<N>::place(const L& a, double x0, double v0, L& v) const {
  const StepMatrices<N>& m = step_;
  L first = L::all(v0), second = L::all(x0) + v0 * m.c;
  for (int i = 0; i < N; ++i) {
    first += a[i] * m.A.column[i];
    second += a[i] * m.A2.column[i];
  }
  v = first;
  return second;
}

template <int N>
void LaneSolver<N>::place_body(const State& begin, std::size_t b) {
  BodyLanes<N>& body = bodies_[b];
  for (int k = 0; k < 3; ++k) body.q[k] = place(body.a[k], begin.q[b][k], begin.v[b][k], body.v[k]);
  sine_and_cosine_unchecked(body.q[2], body.s, body.c);
}

// `angles`: the largest.
template <int N>
void LaneSolver<N>::check_angles(const L& angles) {
  if (!any_beyond_largest_angle(angles)) return;
  for (std::size_t b = 0; b < n_bodies(); ++b) sine_and_cosine(bodies_[b].q[2], bodies_[b].s, bodies_[b].c);
}

template <int N>
void LaneSolver<N>::place_bodies(const State& begin) {
  L angles = L::all(0);
  for (std::size_t b = 0; b < n_bodies(); ++b) {
    place_body(begin, b);
    angles = larger_size(angles, bodies_[b].q[2]);
  }
  check_angles(angles);
}

// Gaps, rates, and the joint's force from them. How much that has changed, over the scale of the bodies that it acts on.
template <int N>
void LaneSolver<N>::place_joint(const State& begin, std::size_t j, L& worst, L& sum) {
  JointLanes<N>& joint = joints_[j];
  const JointData& data = system_.joints[j];
  for (int k = 0; k < 3; ++k) joint.gap[k] = place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], joint.rate[k]);
  double at[3][N];  // of laws that are asked stage by stage
  const auto* linear = std::get_if<LinearLaw>(&data.law);
  for (int s = 0; s < N && !linear; ++s) {
    const S::Vec f = law_force(data.law, {joint.gap[0][s], joint.gap[1][s], joint.gap[2][s]},
                               {joint.rate[0][s], joint.rate[1][s], joint.rate[2][s]});
    for (int k = 0; k < 3; ++k) at[k][s] = f[k];
  }
  for (int k = 0; k < 3; ++k) {
    const L force = linear ? -(linear->k[k] * joint.gap[k] + linear->c[k] * joint.rate[k]) : L::of(at[k]);
    const L change = joint.over_scale[k] * (force - joint.force[k]);
    worst = larger_size(worst, change);
    sum += change;
    joint.force[k] = force;
  }
}

template <int N>
void LaneSolver<N>::place_joints(const State& begin) {
  L change = L::all(0), sum = change;
  for (std::size_t j = 0; j < joints_.size(); ++j) place_joint(begin, j, change, sum);
}

// What is missing in the equations. Eq. (3.6).
template <int N>
void LaneSolver<N>::find_residuals(const State& begin, double h) {
  if (loads_) find_loads(begin, h);
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].missing[k] = bodies_[b].Q[k] - system_.bodies[b].mass[k] * bodies_[b].a[k];
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    L bias[3];
    find_map(j, bias);
    const Placement& at = system_.joints[j].at;
    BodyLanes<N>&A = bodies_[body(at.a)], &B = bodies_[body(at.b)];
    joint.map.push(joint.force, A.missing, B.missing);
    L e[3];
    joint.map.gather(A.a, B.a, e);
    for (int k = 0; k < 3; ++k) joint.e[k] = X(matrices_.T_inverse * (joint.accel[k] - e[k] - bias[k]));
  }
}

template <int N>
void LaneSolver<N>::find_loads(const State& begin, double h) {
  for (int s = 0; s < N; ++s) {
    for (std::size_t b = 0; b < n_bodies(); ++b) motions_[b] = bodies_[b].motion(s);
    system_.external(begin.t + table_.c[s] * h, motions_, Q_, begin.held);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < 3; ++k) bodies_[b].Q[k].set(s, Q_[b][k]);
  }
}

// The map of joint j and its convective acceleration; of a servo less than the target's.
template <int N>
void LaneSolver<N>::find_map(std::size_t j, L (&bias)[3]) {
  const JointData& data = system_.joints[j];
  JointLanes<N>& joint = joints_[j];
  const auto pose = PoseGeometry<L>::between(bodies_[body(data.at.a)].view(), data.at.F, bodies_[body(data.at.b)].view(), data.at.M);
  GapMap<L>& map = joint.map;
  map.take(pose);
  bias[0] = pose.bias_x;
  bias[1] = pose.bias_y;
  bias[2] = L::all(0);
  if (map.function) {
    bias[0] = find_gradient(data, pose, joint);
    bias[1] = L::all(0);
  }
  if (data.servo >= 0) bias[data.servo] -= joint.target_accel;
}

// A gap that is a function of the pose: its gradient into the map; its convective acceleration is returned. theory/joints
// Eq. (2.14).
template <int N>
Lanes<N> LaneSolver<N>::find_gradient(const JointData& joint, const PoseGeometry<L>& pose, JointLanes<N>& lanes) const {
  const BodyLanes<N>&A = bodies_[body(joint.at.a)], &B = bodies_[body(joint.at.b)];
  L bias;
  for (int s = 0; s < N; ++s) {
    const RelativePose z = RelativePose::between(A.motion(s), joint.at.F, B.motion(s), joint.at.M);
    std::visit(
        [&](const auto& probe) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(probe)>, Selection>) {
            const GapFunction g = probe(z.z);
            for (int k = 0; k < 3; ++k) lanes.map.gradient[k].set(s, g.gradient[k]);
            bias.set(s, g.gradient[0] * pose.bias_x[s] + g.gradient[1] * pose.bias_y[s] + z.rate.dot(g.hessian * z.rate));
          }
        },
        joint.probe);
  }
  return bias;
}

// The joints' tangents and loads' slopes at the predicted middle stage.
template <int N>
void LaneSolver<N>::linearize(double t, HeldJumps held) {
  const int i = kMiddle;
  for (std::size_t b = 0; b < n_bodies(); ++b) motions_[b] = bodies_[b].motion(i);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointData& data = system_.joints[j];
    JointLanes<N>& joint = joints_[j];
    joint.frozen = joint.map.lane(i);
    if (const auto* linear = std::get_if<LinearLaw>(&data.law)) {
      for (int k = 0; k < 3; ++k) {
        joint.K(k, k) = linear->k[k];
        joint.C(k, k) = linear->c[k];
        joint.frozen_force[k] = joint.force[k][i];
      }
    } else {
      const Response response = respond(data.law, {joint.gap[0][i], joint.gap[1][i], joint.gap[2][i]},
                                        {joint.rate[0][i], joint.rate[1][i], joint.rate[2][i]});
      joint.K = response.stiffness;
      joint.C = response.damping;
      joint.frozen_force = response.force;
    }
  }
  load_blocks_.clear();
  system_.external_tangents(t, motions_, [this](int a, int b, const S::Mat& dq, const S::Mat& dv) {
    load_blocks_.push_back({a, b, dq, dv});
  }, held);
}

// Z(mu) of Eq. (3.8) at every eigenvalue, and the weights of (3.10).
template <int N>
bool LaneSolver<N>::factorize(double h) {
  const X mu = (1 / h) * matrices_.eigenvalue, once = reciprocal(mu), twice = once * once;
  mu2_ = mu * mu;
  lu_.set_zero();
  for (int i = 0; i < system_.n_bodies(); ++i)
    for (int r = 0; r < 3; ++r) lu_.diagonal(i)(r, r) = system_.bodies[i].mass[r] * mu2_;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    if (joint.diagonal) {
      for (int k = 0; k < 3; ++k) joint.weight[k] = joint.K(k, k) * twice + joint.C(k, k) * once;
    } else {
      for (int k = 0; k < 9; ++k) joint.weight[k] = joint.K(k / 3, k % 3) * twice + joint.C(k / 3, k % 3) * once;
    }
    if (joint.diagonal && !joint.map.function) add_pose_joint(j, mu);
    else add_joint(j, mu);
  }
  for (const LoadBlock& b : load_blocks_)  // of a matrix that is not symmetric
    add_block(b.i == b.j ? lu_.diagonal(b.i) : lu_.off_diagonal(system_.pattern().slot(b.i, b.j)), b.dq, b.dv, mu, -1);
  return lu_.factorize();
}

template <int N>
void LaneSolver<N>::add_block(Block<X, 3>& block, const S::Mat& K, const S::Mat& C, const X& mu, double sign) {
  const X one(1.0);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) block(r, c) += (sign * K(r, c)) * one + (sign * C(r, c)) * mu;
}

// G' (K + mu C) G - N of one joint, of any kind.
template <int N>
void LaneSolver<N>::add_joint(std::size_t j, const X& mu) {
  const JointData& data = system_.joints[j];
  const JointLanes<N>& joint = joints_[j];
  const Placement& at = data.at;
  const RelativePose pose = system_.pose(at, motions_);
  const Reading r = read(data.probe, pose);
  const auto geometric = geometric_stiffness(data.probe, pose, joint.frozen_force);
  const S::Mat KA = joint.K * r.GA(), KB = joint.K * r.GB(), CA = joint.C * r.GA(), CB = joint.C * r.GB();
  const S::Mat At = r.GA().transpose(), Bt = r.GB().transpose();
  if (at.a != kGround) add_block(lu_.diagonal(at.a), At * KA - geometric.template block<3, 3>(0, 0), At * CA, mu, 1);
  if (at.b != kGround) add_block(lu_.diagonal(at.b), Bt * KB - geometric.template block<3, 3>(3, 3), Bt * CB, mu, 1);
  if (at.a == kGround || at.b == kGround) return;
  BlockPattern::Slot slot = slots_[j];
  if (lu_.has(slot)) add_block(lu_.off_diagonal(slot), At * KB - geometric.template block<3, 3>(0, 3), At * CB, mu, 1);
  slot.upper = !slot.upper;
  if (lu_.has(slot)) add_block(lu_.off_diagonal(slot), Bt * KA - geometric.template block<3, 3>(3, 0), Bt * CA, mu, 1);
}

// The same where the gap is the relative pose and its law has a spring and a damper in each component.
template <int N>
void LaneSolver<N>::add_pose_joint(std::size_t j, const X& mu) {
  const JointLanes<N>& joint = joints_[j];
  const X one(1.0);
  X w[3];
  for (int k = 0; k < 3; ++k) w[k] = joint.K(k, k) * one + joint.C(k, k) * mu;
  add_pose_blocks(lu_, system_.joints[j].at, slots_[j], joint.frozen, w, joint.frozen_force);
}

// One Newton correction: into the diagonal frame, the solve, back, and where that leads. Eqs. (3.9)-(3.11). Its size: as body
// forces, and what the joint forces have changed, over the scale.
template <int N>
double LaneSolver<N>::correct(const State& begin) {
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) rhs_[b][k] = X(matrices_.T_inverse * bodies_[b].missing[k]);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointLanes<N>& joint = joints_[j];
    X f[3];
    weigh(joint.diagonal, joint.weight, joint.e, f);
    const Placement& at = system_.joints[j].at;
    joint.frozen.push(f, rhs_[body(at.a)], rhs_[body(at.b)]);
  }
  lu_.solve(rhs_);
  rhs_.back() = {};
  L worst = L::all(0), sum = worst, angles = worst;
  for (std::size_t b = 0; b < n_bodies(); ++b) {
    for (int k = 0; k < 3; ++k) {
      rhs_[b][k] = mu2_ * rhs_[b][k];
      const L delta = matrices_.T * rhs_[b][k].x, relative = bodies_[b].over_scale[k] * delta;
      bodies_[b].a[k] += delta;
      worst = larger_size(worst, relative);
      sum += relative;
    }
    place_body(begin, b);
    angles = larger_size(angles, bodies_[b].q[2]);
  }
  check_angles(angles);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    const Placement& at = system_.joints[j].at;
    X e[3];
    joint.frozen.gather(&rhs_[body(at.a)][0], &rhs_[body(at.b)][0], e);
    for (int k = 0; k < 3; ++k) joint.accel[k] += matrices_.T * (e[k] - joint.e[k]).x;
    place_joint(begin, j, worst, sum);
  }
  return largest(worst, sum);
}

template <int N>
void LaneSolver<N>::write(std::vector<Stage>& stages) const {
  for (int s = 0; s < N; ++s) {
    Stage& stage = stages[s];
    const bool whole = s == N - 1 || loads_ || !simple_;
    const auto copy = [s](const L* from, S::Vec& to) { to << from[0][s], from[1][s], from[2][s]; };
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      copy(bodies_[b].a, stage.a[b]);
      if (!whole) continue;
      copy(bodies_[b].q, stage.q[b]);
      copy(bodies_[b].v, stage.v[b]);
      copy(bodies_[b].Q, stage.Q[b]);
      stage.m[b] = bodies_[b].motion(s);
    }
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      if (whole) copy(joints_[j].gap, stage.gap[j]);
      copy(joints_[j].rate, stage.gap_rate[j]);
      copy(joints_[j].accel, stage.gap_accel[j]);
      copy(joints_[j].force, stage.force[j]);
    }
  }
}

template <int N>
double LaneSolver<N>::residual(int j) const {
  double square = 0;
  for (const X& e : joints_[j].e) {
    const double at_end = (matrices_.T * e.x)[N - 1];
    square += at_end * at_end;
  }
  return std::sqrt(square);
}

template <int N>
void LaneSolver<N>::find_tails(const State& begin, std::vector<Three>& bodies, std::vector<Three>& gaps) const {
  const auto put = [](const L& from, Lanes<3>& to) {
    for (int back = 0; back < 3; ++back) to.set(back, from[back]);
  };
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) put(begin.a[b][k] * matrices_.tail_of_start + matrices_.tail * bodies_[b].a[k], bodies[b][k]);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (int k = 0; k < 3; ++k) put(matrices_.tail_of_stages * joints_[j].accel[k], gaps[j][k]);
}

template <int N>
void LaneSolver<N>::find_yield(std::vector<Three>& forces) const {
  lu_.solve(forces);
  const double mu2 = mu2_.x[N - 1];
  for (Three& x : forces)
    for (int k = 0; k < 3; ++k) x[k] = mu2 * x[k];
}

namespace {

// The same text for registers of every width: everything that is made of lanes is inlined into these functions.
template <int N>
class NarrowSolver final : public LaneSolver<N> {
 public:
  using LaneSolver<N>::LaneSolver;
  bool solve(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters) override {
    return this->solve_stages(begin, h, before, last_h, scale, counters);
  }
  void yield_to(std::vector<StageSolver::Three>& forces) const override { this->find_yield(forces); }
  void tails(const State& begin, std::vector<StageSolver::Three>& bodies, std::vector<StageSolver::Three>& gaps) const override {
    this->find_tails(begin, bodies, gaps);
  }
};

#ifdef PINTLE_WIDE
template <int N>
class WideSolver final : public LaneSolver<N> {
 public:
  using LaneSolver<N>::LaneSolver;
  PINTLE_WIDE bool solve(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters) override {
    return this->solve_stages(begin, h, before, last_h, scale, counters);
  }
  PINTLE_WIDE void yield_to(std::vector<StageSolver::Three>& forces) const override { this->find_yield(forces); }
  PINTLE_WIDE void tails(const State& begin, std::vector<StageSolver::Three>& bodies, std::vector<StageSolver::Three>& gaps) const override {
    this->find_tails(begin, bodies, gaps);
  }
};

// For five stages: in narrower registers they take turns.
class WidestSolver final : public LaneSolver<5> {
 public:
  using LaneSolver<5>::LaneSolver;
  PINTLE_WIDEST bool solve(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters) override {
    return this->solve_stages(begin, h, before, last_h, scale, counters);
  }
  PINTLE_WIDEST void yield_to(std::vector<StageSolver::Three>& forces) const override { this->find_yield(forces); }
  PINTLE_WIDEST void tails(const State& begin, std::vector<StageSolver::Three>& bodies, std::vector<StageSolver::Three>& gaps) const override {
    this->find_tails(begin, bodies, gaps);
  }
};
#endif

template <int N>
std::unique_ptr<StageSolver> make_solver(const System& system, const RadauTable& table, double tolerance, Steps steps) {
#ifdef PINTLE_WIDE
  if constexpr (N == 5)
    if (has_widest_registers()) return std::make_unique<WidestSolver>(system, table, tolerance, steps);
  if (has_wide_registers()) return std::make_unique<WideSolver<N>>(system, table, tolerance, steps);
#endif
  return std::make_unique<NarrowSolver<N>>(system, table, tolerance, steps);
}

}  // namespace

std::unique_ptr<StageSolver> make_stage_solver(const System& system, const RadauTable& table, double tolerance, Steps steps) {
  if (table.n == 5) return make_solver<5>(system, table, tolerance, steps);
  return make_solver<3>(system, table, tolerance, steps);
}

}  // namespace pintle
