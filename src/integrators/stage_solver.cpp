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
LaneSolver<N>::LaneSolver(const System& system, const RadauTable& table, double tolerance)
    : system_(system), table_(table), matrices_(table), tolerance_(tolerance), loads_(!system.loads.empty() || !system.applied.empty()),
      bodies_(system.bodies.size() + 1), joints_(system.joints.size()), Q_(system.bodies.size()), motions_(system.bodies.size()), slots_(system.joints.size()),
      lu_(system.pattern()), rhs_(system.bodies.size() + 1) {
  bodies_.back().c = L::all(1);  // the ground; what falls on it is not looked at
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].Q[k] = L::all(system.bodies[b].gravity[k]);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointData& joint = system.joints[j];
    joints_[j].map.function = !std::holds_alternative<Selection>(joint.probe);
    joints_[j].diagonal = std::holds_alternative<LinearLaw>(joint.law);
    if (joint.at.a != kGround && joint.at.b != kGround) slots_[j] = system.pattern().slot(joint.at.a, joint.at.b);
  }
}

template <int N>
bool LaneSolver<N>::solve_stages(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale,
                                 Counters& counters) {
  predict(begin, h, before, last_h);
  find_targets(begin.t, h);
  place(begin, h);
  find_forces(scale);
  contraction_.start();
  bool fresh = h != factorized_for_ || contraction_.rate() > kGood, wanted = fresh;  // a factorisation
  for (int iteration = 0; iteration < NewtonContraction::kMaxIterations; ++iteration) {
    find_residuals(begin, h);
    counters.evaluations += N;
    if (wanted) {
      if (!renew(begin, h, counters)) return false;
      wanted = false;
    }
    const double of_bodies = correct(scale);
    place(begin, h);
    ++counters.newton_iterations;
    const auto verdict = contraction_.judge(iteration, std::max(of_bodies, find_forces(scale)), tolerance_);
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
      const RadauTable::Vec w = table_.weights(1 + table_.c[s] * h / last_h);
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
    for (int s = 0; s < N; ++s) joints_[j].target_accel.set(s, joint.target.second_order(std::array{t + table_.c[s] * h}, 0)[2]);
  }
}

// Where the stages are, from their accelerations. Eq. (3.5).
template <int N>
void LaneSolver<N>::place(const State& begin, double h) {
  LaneMatrix<N> A, A2;
  for (int i = 0; i < N; ++i) {
    A.column[i] = h * matrices_.A.column[i];
    A2.column[i] = (h * h) * matrices_.A2.column[i];
  }
  const L hc = h * matrices_.c;
  const auto integrate = [&](const L& a, double x0, double v0, L& x, L& v) {
    L first = L::all(v0), second = L::all(x0) + v0 * hc;
    for (int i = 0; i < N; ++i) {
      first += a[i] * A.column[i];
      second += a[i] * A2.column[i];
    }
    v = first;
    x = second;
  };
  for (std::size_t b = 0; b < n_bodies(); ++b) {
    BodyLanes<N>& body = bodies_[b];
    for (int k = 0; k < 3; ++k) integrate(body.a[k], begin.q[b][k], begin.v[b][k], body.q[k], body.v[k]);
    sine_and_cosine(body.q[2], body.s, body.c);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    for (int k = 0; k < 3; ++k) integrate(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], joint.gap[k], joint.rate[k]);
  }
}

// Joint forces from gaps and rates. How much they have changed, over the scale of the bodies that they act on.
template <int N>
double LaneSolver<N>::find_forces(const LoadScale& scale) {
  L worst = L::all(0), sum = worst;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    const JointData& data = system_.joints[j];
    double at[3][N];  // of laws that are asked stage by stage
    const auto* linear = std::get_if<LinearLaw>(&data.law);
    for (int s = 0; s < N && !linear; ++s) {
      const S::Vec f = law_force(data.law, {joint.gap[0][s], joint.gap[1][s], joint.gap[2][s]},
                                 {joint.rate[0][s], joint.rate[1][s], joint.rate[2][s]});
      for (int k = 0; k < 3; ++k) at[k][s] = f[k];
    }
    for (int k = 0; k < 3; ++k) {
      const S::Vec& on = scale.body[data.at.a == kGround ? data.at.b : data.at.a];
      const S::Vec& beside = scale.body[data.at.b == kGround ? data.at.a : data.at.b];
      const L force = linear ? -(linear->k[k] * joint.gap[k] + linear->c[k] * joint.rate[k]) : L::of(at[k]);
      const L change = (1 / std::max(on[k], beside[k])) * (force - joint.force[k]);
      worst = larger_size(worst, change);
      sum += change;
      joint.force[k] = force;
    }
  }
  return largest(worst, sum);
}

// What is missing in the equations. Eq. (3.6).
template <int N>
void LaneSolver<N>::find_residuals(const State& begin, double h) {
  if (loads_) find_loads(begin, h);
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) bodies_[b].residual[k] = system_.bodies[b].mass[k] * bodies_[b].a[k] - bodies_[b].Q[k];
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    find_map(j);
    const Placement& at = system_.joints[j].at;
    BodyLanes<N>&A = bodies_[body(at.a)], &B = bodies_[body(at.b)];
    const auto f = joint.map.spread(joint.force);
    A.residual[0] += f.fx;
    A.residual[1] += f.fy;
    A.residual[2] -= f.ma;
    B.residual[0] -= f.fx;
    B.residual[1] -= f.fy;
    B.residual[2] -= f.mb;
    L e[3];
    joint.map.gather(A.a, B.a, e);
    for (int k = 0; k < 3; ++k) joint.residual[k] += joint.accel[k] - e[k];
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

// The map of joint j and, in its residual, minus the convective acceleration.
template <int N>
void LaneSolver<N>::find_map(std::size_t j) {
  const JointData& data = system_.joints[j];
  JointLanes<N>& joint = joints_[j];
  const auto pose = PoseGeometry<L>::between(bodies_[body(data.at.a)].view(), data.at.F, bodies_[body(data.at.b)].view(), data.at.M);
  GapMap<L>& map = joint.map;
  map.take(pose);
  joint.residual[0] = -pose.bias_x;
  joint.residual[1] = -pose.bias_y;
  joint.residual[2] = L::all(0);
  if (map.function) {
    joint.residual[0] = -find_gradient(data, pose, joint);
    joint.residual[1] = L::all(0);
  }
  if (data.servo >= 0) joint.residual[data.servo] += joint.target_accel;
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
  for (const LoadBlock& b : load_blocks_)
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
  add_block(lu_.off_diagonal(slot), At * KB - geometric.template block<3, 3>(0, 3), At * CB, mu, 1);
  slot.upper = !slot.upper;
  add_block(lu_.off_diagonal(slot), Bt * KA - geometric.template block<3, 3>(3, 0), Bt * CA, mu, 1);
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

// One Newton correction: into the diagonal frame, the solve, back. Eqs. (3.9)-(3.11). Its size as body forces over the scale.
template <int N>
double LaneSolver<N>::correct(const LoadScale& scale) {
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) rhs_[b][k] = X(-(matrices_.T_inverse * bodies_[b].residual[k]));
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    X f[3];
    for (int k = 0; k < 3; ++k) joint.e[k] = X(matrices_.T_inverse * joint.residual[k]);
    for (int k = 0; k < 3; ++k)
      f[k] = joint.diagonal ? joint.weight[k] * joint.e[k]
                            : joint.weight[3 * k] * joint.e[0] + joint.weight[3 * k + 1] * joint.e[1] + joint.weight[3 * k + 2] * joint.e[2];
    const auto g = joint.frozen.spread(f);
    const Placement& at = system_.joints[j].at;
    BlockVec<X, 3>&A = rhs_[body(at.a)], &B = rhs_[body(at.b)];
    A[0] -= g.fx;
    A[1] -= g.fy;
    A[2] += g.ma;
    B[0] += g.fx;
    B[1] += g.fy;
    B[2] += g.mb;
  }
  lu_.solve(rhs_);
  rhs_.back() = {};
  L worst = L::all(0), sum = L::all(0);
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) {
      rhs_[b][k] = mu2_ * rhs_[b][k];
      const L delta = matrices_.T * rhs_[b][k].x, relative = (system_.bodies[b].mass[k] / scale.body[b][k]) * delta;
      bodies_[b].a[k] += delta;
      worst = larger_size(worst, relative);
      sum += relative;
    }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointLanes<N>& joint = joints_[j];
    const Placement& at = system_.joints[j].at;
    X e[3];
    joint.frozen.gather(&rhs_[body(at.a)][0], &rhs_[body(at.b)][0], e);
    for (int k = 0; k < 3; ++k) joint.accel[k] += matrices_.T * (e[k] - joint.e[k]).x;
  }
  return largest(worst, sum);
}

template <int N>
void LaneSolver<N>::write(std::vector<Stage>& stages) const {
  for (int s = 0; s < N; ++s) {
    Stage& stage = stages[s];
    const auto copy = [s](const L* from, S::Vec& to) { to << from[0][s], from[1][s], from[2][s]; };
    for (std::size_t b = 0; b < n_bodies(); ++b) {
      copy(bodies_[b].q, stage.q[b]);
      copy(bodies_[b].v, stage.v[b]);
      copy(bodies_[b].a, stage.a[b]);
      stage.m[b] = bodies_[b].motion(s);
      copy(bodies_[b].Q, stage.Q[b]);
    }
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      copy(joints_[j].gap, stage.gap[j]);
      copy(joints_[j].rate, stage.gap_rate[j]);
      copy(joints_[j].accel, stage.gap_accel[j]);
      copy(joints_[j].force, stage.force[j]);
    }
  }
}

template <int N>
double LaneSolver<N>::residual(int j) const {
  const L* r = joints_[j].residual;
  return std::hypot(r[0][N - 1], r[1][N - 1], r[2][N - 1]);
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
};

// For five stages: in narrower registers they take turns.
class WidestSolver final : public LaneSolver<5> {
 public:
  using LaneSolver<5>::LaneSolver;
  PINTLE_WIDEST bool solve(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters) override {
    return this->solve_stages(begin, h, before, last_h, scale, counters);
  }
  PINTLE_WIDEST void yield_to(std::vector<StageSolver::Three>& forces) const override { this->find_yield(forces); }
};
#endif

template <int N>
std::unique_ptr<StageSolver> make_solver(const System& system, const RadauTable& table, double tolerance) {
#ifdef PINTLE_WIDE
  if constexpr (N == 5)
    if (has_widest_registers()) return std::make_unique<WidestSolver>(system, table, tolerance);
  if (has_wide_registers()) return std::make_unique<WideSolver<N>>(system, table, tolerance);
#endif
  return std::make_unique<NarrowSolver<N>>(system, table, tolerance);
}

}  // namespace

std::unique_ptr<StageSolver> make_stage_solver(const System& system, const RadauTable& table, double tolerance) {
  if (table.n == 5) return make_solver<5>(system, table, tolerance);
  return make_solver<3>(system, table, tolerance);
}

}  // namespace pintle
