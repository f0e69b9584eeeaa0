// Simplified Newton on all stages at once: they stand side by side in the lanes of Lanes<N>, and so do the real and complex
// systems into which their equations fall apart.
#include "integrators/lane_solver_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "integrators/pose_blocks.h"
#include "solve/wide.h"

namespace pintle {

using S = Planar;

template <int N>
LaneSolver<N>::LaneSolver(const System& system, const RadauTable& table, double tolerance, Steps steps)
    : system_(system), table_(table), matrices_(table), tolerance_(tolerance), steps_(steps), loads_(system.has_loads()),
      bodies_(system.bodies.size() + 1), joints_(system.joints.size()), Q_(system.bodies.size()), loads_on_(loads_ ? system.bodies.size() + 1 : 0),
      motions_(system.bodies.size()), lu_(system.pattern(), loads_ ? Symmetry::kNone : symmetry_of_joints(system)), rhs_(system.bodies.size() + 1) {
  bodies_.back().c = L::all(1);  // the ground; what falls on it is not looked at
  const auto body = [&](int index) { return index == kGround ? static_cast<int>(n_bodies()) : index; };
  bool servos = false;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointData& data = system.joints[j];
    Joint& joint = joints_[j];
    joint.a = body(data.at.a);
    joint.b = body(data.at.b);
    for (const int index : {data.at.a, data.at.b}) joint.last = std::max(joint.last, index);
    joint.function = !std::holds_alternative<Selection>(data.probe);
    joint.F = {data.at.F.p, data.at.F.c, data.at.F.s};
    joint.M = {data.at.M.p, data.at.M.c, data.at.M.s};
    joint.servo = static_cast<signed char>(data.servo);
    if (const auto* law = std::get_if<LinearLaw>(&data.law)) {
      joint.linear = true;
      for (int k = 0; k < 3; ++k) {
        joint.k[k] = law->k[k];
        joint.c[k] = law->c[k];
      }
    } else {
      joint.full = static_cast<int>(full_.size());
      full_.emplace_back();
    }
    joint.loses = joint.linear && data.servo < 0;
    simple_ = simple_ && joint.loses;
    poses_ = poses_ && joint.linear && !joint.function;
    servos = servos || data.servo >= 0;
    if (data.at.a != kGround && data.at.b != kGround) joint.slot = system.pattern().slot(data.at.a, data.at.b);
  }
  simple_ = simple_ && !loads_;
  order_.resize(joints_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [this](int i, int j) { return joints_[i].last < joints_[j].last; });
  if (servos) target_accel_.assign(joints_.size(), L::all(0));
}

// Accelerations at the stages as the last step's curve goes on; without one those at the start.
template <int N>
struct LaneSolver<N>::Curve {
  const StepNodes* nodes;
  std::array<L, RadauTable::kMaxNodes> weight;

  Curve(const RadauTable& table, Steps steps, double h, const StepNodes* before, double last_h) : nodes(before) {
    for (int s = 0; s < N && before; ++s) {
      const double ratio = h / last_h;
      const RadauTable::Vec w = steps == Steps::kLong ? table.continuation(table.c[s], ratio) : table.weights(1 + table.c[s] * ratio);
      for (int k = 0; k <= N; ++k) weight[k].set(s, w[k]);
    }
  }
  L ahead(const std::vector<Vecs> StepNodes::*of, const Vecs& start, std::size_t i, int k) const {
    if (!nodes) return L::all(start[i][k]);
    const std::vector<Vecs>& node = nodes->*of;
    L x = node[0][i][k] * weight[0];
    for (int n = 1; n <= N; ++n) x += node[n][i][k] * weight[n];
    return x;
  }
};

template <int N>
bool LaneSolver<N>::solve_stages(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale,
                                 Counters& counters) {
  step_.scale(matrices_, h);
  const Curve curve(table_, steps_, h, before, last_h);
  find_targets(begin.t, h);
  contraction_.start();
  // An old factorisation does not know the new side of a jump: without a step before there is none that serves.
  bool fresh = !before || h != factorized_for_ || contraction_.rate() > kGood, wanted = fresh;  // a factorisation
  const Curve* unplaced = &curve;  // the stages are
  for (int iteration = 0; iteration < NewtonContraction::kMaxIterations; ++iteration) {
    answer_all(begin, h, std::exchange(unplaced, nullptr), scale, wanted);
    counters.evaluations += N;
    double correction = 0;
    if (wanted) counters.factorizations += 1 + N / 2;
    if (!correct(begin, wanted, correction)) {
      factorized_for_ = 0;
      return false;
    }
    if (wanted) factorized_for_ = h;
    wanted = false;
    ++counters.newton_iterations;
    const auto verdict = contraction_.judge(iteration, correction, tolerance_);
    if (verdict == NewtonContraction::Verdict::kDone) {
      if (!begin.held.empty()) find_balanced_loads();
      return true;
    }
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

// What is missing in all equations, and the matrix of the correction that answers it. Bodies and joints that follow each other are done
// together, while they are at hand; loads want to know where all of the bodies are.
template <int N>
void LaneSolver<N>::answer_all(const State& begin, double h, const Curve* unplaced, const LoadScale& scale, bool linearized) {
  const bool whole = loads_ || !poses_;
  if (linearized) begin_matrix(h);
  std::size_t next = 0;
  for (std::size_t first = 0, end = 0; first < n_bodies(); first = end) {
    end = whole ? n_bodies() : std::min(first + kTile, n_bodies());
    if (unplaced) begin_bodies(begin, *unplaced, scale, first, end);
    if (loads_) find_loads(begin, h);
    for (std::size_t b = first; b < end; ++b) {
      find_missing(b);
      if (linearized) lu_.set_diagonal(static_cast<int>(b), [&](int k) { return system_.bodies[b].mass[k] * mu2_; });
    }
    if (linearized && whole) add_loads(begin, h);
    for (; next < order_.size() && joints_[order_[next]].last < static_cast<int>(end); ++next) {
      const std::size_t j = order_[next];
      if (unplaced) begin_joint(begin, *unplaced, scale, j);
      L bias[3];
      const GapMap<L> map = find_map(j, bias);
      if (linearized) linearize(begin, j, map);
      answer(j, map, bias);
    }
  }
}

// What corrections are measured by, and a first guess.
template <int N>
void LaneSolver<N>::begin_bodies(const State& begin, const Curve& curve, const LoadScale& scale, std::size_t first, std::size_t end) {
  L angles = L::all(0);
  for (std::size_t b = first; b < end; ++b) {
    Body& body = bodies_[b];
    for (int k = 0; k < 3; ++k) {
      body.over_scale[k] = system_.bodies[b].mass[k] / scale.body[b][k];
      body.a[k] = curve.ahead(&StepNodes::a, begin.a, b, k);
    }
    place_body(begin, b);
    angles = larger_size(angles, body.q[2]);
  }
  check_angles(angles, first, end);
}

template <int N>
void LaneSolver<N>::begin_joint(const State& begin, const Curve& curve, const LoadScale& scale, std::size_t j) {
  Joint& joint = joints_[j];
  const int ground = static_cast<int>(n_bodies());
  const S::Vec& on = scale.body[joint.a == ground ? joint.b : joint.a];
  const S::Vec& beside = scale.body[joint.b == ground ? joint.a : joint.b];
  for (int k = 0; k < 3; ++k) {
    joint.over_scale[k] = 1 / std::max(on[k], beside[k]);
    joint.accel[k] = curve.ahead(&StepNodes::gap_accel, begin.gap_accel, j, k);
  }
  L change = L::all(0), sum = change;
  place_joint(begin, j, change, sum);
}

// The accelerations that servos are to follow.
template <int N>
void LaneSolver<N>::find_targets(double t, double h) {
  for (std::size_t j = 0; j < target_accel_.size(); ++j) {
    const JointData& joint = system_.joints[j];
    if (joint.servo < 0 || joint.target.variables().empty()) continue;
    for (int s = 0; s < N; ++s) target_accel_[j].set(s, servo_target(joint, t + table_.c[s] * h)[2]);
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
  Body& body = bodies_[b];
  for (int k = 0; k < 3; ++k) body.q[k] = place(body.a[k], begin.q[b][k], begin.v[b][k], body.v[k]);
  sine_and_cosine_unchecked(body.q[2], body.s, body.c);
}

// `angles`: the largest.
template <int N>
void LaneSolver<N>::check_angles(const L& angles, std::size_t first, std::size_t end) {
  if (!any_beyond_largest_angle(angles)) return;
  for (std::size_t b = first; b < end; ++b) sine_and_cosine(bodies_[b].q[2], bodies_[b].s, bodies_[b].c);
}

// The joint's force at its gaps and their rates. How much that has changed, over the scale of the bodies that it acts on.
template <int N>
void LaneSolver<N>::place_joint(const State& begin, std::size_t j, L& worst, L& sum) {
  Joint& joint = joints_[j];
  L gap[3], rate[3];
  for (int k = 0; k < 3; ++k) gap[k] = place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rate[k]);
  double at[3][N];  // of laws that are asked stage by stage
  for (int s = 0; s < N && !joint.linear; ++s) {
    const S::Vec f = law_force(system_.joints[j].law, {gap[0][s], gap[1][s], gap[2][s]}, {rate[0][s], rate[1][s], rate[2][s]});
    for (int k = 0; k < 3; ++k) at[k][s] = f[k];
  }
  for (int k = 0; k < 3; ++k) {
    const L force = joint.linear ? -(joint.k[k] * gap[k] + joint.c[k] * rate[k]) : L::of(at[k]);
    const L change = joint.over_scale[k] * (force - joint.force[k]);
    worst = larger_size(worst, change);
    sum += change;
    joint.force[k] = force;
  }
}

// What is missing in a body's equations but for the joints' forces. Eq. (3.6).
template <int N>
void LaneSolver<N>::find_missing(std::size_t b) {
  const BodyData& data = system_.bodies[b];
  for (int k = 0; k < 3; ++k) {
    bodies_[b].missing[k] = (loads_ ? loads_on_[b][k] : L::all(data.gravity[k])) - data.mass[k] * bodies_[b].a[k];
    rhs_[b][k] = X(L::all(0));
  }
}

template <int N>
void LaneSolver<N>::find_loads(const State& begin, double h) {
  for (int s = 0; s < N; ++s) {
    for (std::size_t b = 0; b < n_bodies(); ++b) motions_[b] = bodies_[b].motion(s);
    system_.external(begin.t + table_.c[s] * h, motions_, Q_, begin.held);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < 3; ++k) loads_on_[b][k].set(s, Q_[b][k]);
  }
}

// The loads that the last correction has counted on. A motor that is held at a jump has a ramp so steep that the effort of the last
// bits of a velocity says less.
template <int N>
void LaneSolver<N>::find_balanced_loads() {
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < 3; ++k) loads_on_[b][k] = system_.bodies[b].mass[k] * bodies_[b].a[k];
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    L bias[3];
    const L *f = joints_[j].force, against[3] = {-f[0], -f[1], -f[2]};
    find_map(j, bias).push(against, loads_on_[joints_[j].a], loads_on_[joints_[j].b]);
  }
}

// Joint j's force on its bodies, and what falls on them of what is missing in its own equation. Its acceleration becomes what the
// bodies' make of it: that is what the correction starts from. Eq. (3.6).
template <int N>
void LaneSolver<N>::answer(std::size_t j, const GapMap<L>& map, const L (&bias)[3]) {
  Joint& joint = joints_[j];
  Body &A = bodies_[joint.a], &B = bodies_[joint.b];
  map.push(joint.force, A.missing, B.missing);
  L e[3];
  X missing[3], f[3];
  map.gather(A.a, B.a, e);
  for (int k = 0; k < 3; ++k) {
    e[k] += bias[k];
    missing[k] = X(matrices_.T_inverse * (joint.accel[k] - e[k]));
    joint.accel[k] = e[k];
  }
  if (joint.linear)
    for (int k = 0; k < 3; ++k) f[k] = (joint.k[k] * twice_ + joint.c[k] * once_) * missing[k];
  else
    weigh(false, full_[joint.full].data(), missing, f);
  joint.frozen.push(f, rhs_[joint.a], rhs_[joint.b]);
}

// The map of joint j and its convective acceleration; of a servo less than the target's.
template <int N>
GapMap<Lanes<N>> LaneSolver<N>::find_map(std::size_t j, L (&bias)[3]) const {
  const Joint& joint = joints_[j];
  const auto pose = PoseGeometry<L>::between(bodies_[joint.a].view(), joint.F, bodies_[joint.b].view(), joint.M);
  GapMap<L> map;
  map.function = joint.function;
  map.take(pose);
  bias[0] = pose.bias_x;
  bias[1] = pose.bias_y;
  bias[2] = L::all(0);
  if (joint.function) {
    bias[0] = find_gradient(j, pose, map);
    bias[1] = L::all(0);
  }
  if (joint.servo >= 0) bias[joint.servo] -= target_accel_[j];
  return map;
}

// A gap that is a function of the pose: its gradient into the map; its convective acceleration is returned. theory/joints
// Eq. (2.14).
template <int N>
Lanes<N> LaneSolver<N>::find_gradient(std::size_t j, const PoseGeometry<L>& pose, GapMap<L>& map) const {
  const JointData& data = system_.joints[j];
  const Body &A = bodies_[joints_[j].a], &B = bodies_[joints_[j].b];
  L bias;
  for (int s = 0; s < N; ++s) {
    const RelativePose z = RelativePose::between(A.motion(s), data.at.F, B.motion(s), data.at.M);
    std::visit(
        [&](const auto& probe) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(probe)>, Selection>) {
            const GapFunction g = probe(z.z);
            for (int k = 0; k < 3; ++k) map.gradient[k].set(s, g.gradient[k]);
            bias.set(s, g.gradient[0] * pose.bias_x[s] + g.gradient[1] * pose.bias_y[s] + z.rate.dot(g.hessian * z.rate));
          }
        },
        data.probe);
  }
  return bias;
}

// One Newton correction: into the diagonal frame, the solve, back, and where that leads. Eqs. (3.9)-(3.11). Its size: as body
// forces, and what the joint forces have changed, over the scale. False where the matrix, which may have to be factorised, is singular.
template <int N>
bool LaneSolver<N>::correct(const State& begin, bool factorize, double& size) {
  L worst = L::all(0), sum = worst, angles = worst;
  const auto complete = [&](int b, BlockVec<X, 3>& x) {
    for (int k = 0; k < 3; ++k) x[k] += X(matrices_.T_inverse * bodies_[b].missing[k]);
  };
  const auto move = [&](int b, const BlockVec<X, 3>& x) {
    Body& body = bodies_[b];
    for (int k = 0; k < 3; ++k) {
      const L delta = back_ * x[k].x, relative = body.over_scale[k] * delta;
      body.missing[k] = delta;
      body.a[k] += delta;
      worst = larger_size(worst, relative);
      sum += relative;
    }
    place_body(begin, b);
    angles = larger_size(angles, body.q[2]);
  };
  if (!factorize) lu_.solve(rhs_, complete, move);
  else if (!lu_.factorize_and_solve(rhs_, complete, move)) return false;
  check_angles(angles, 0, n_bodies());
  for (L& still : bodies_.back().missing) still = L::all(0);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = joints_[j];
    L e[3];
    joint.frozen.gather(bodies_[joint.a].missing, bodies_[joint.b].missing, e);
    for (int k = 0; k < 3; ++k) joint.accel[k] += e[k];
    place_joint(begin, j, worst, sum);
  }
  size = largest(worst, sum);
  return true;
}

template <int N>
void LaneSolver<N>::write_stages(const State& begin, std::vector<Stage>& stages, StageTails& tails) const {
  const bool simple = simple_;
  const auto copy = [](const L* from, int s, S::Vec& to) { to << from[0][s], from[1][s], from[2][s]; };
  const auto put = [](const L& from, Lanes<4>& to) { to = Lanes<4>::of({from[0], from[1], from[2], 0}); };
  for (std::size_t b = 0; b < n_bodies(); ++b) {
    const Body& body = bodies_[b];
    for (int s = 0; s < N; ++s) {
      Stage& stage = stages[s];
      copy(body.a, s, stage.a[b]);
      if (simple && s < N - 1) continue;
      copy(body.q, s, stage.q[b]);
      copy(body.v, s, stage.v[b]);
      stage.m[b] = body.motion(s);
      if (loads_) copy(loads_on_[b].a.data(), s, stage.Q[b]);
      else stage.Q[b] = system_.bodies[b].gravity;
    }
    for (int k = 0; k < 3; ++k) put(begin.a[b][k] * matrices_.tail_of_start + matrices_.tail * body.a[k], tails.bodies[b][k]);
  }
  L loss = L::all(0);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    L gap[3], rate[3];
    for (int k = 0; k < 3; ++k) {
      gap[k] = place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rate[k]);
      put(matrices_.tail_of_stages * joint.accel[k], tails.gaps[j][k]);
    }
    if (joint.loses)
      for (int k = 0; k < 3; ++k) loss += joint.c[k] * (rate[k] * rate[k]);
    for (int s = 0; s < N; ++s) {
      Stage& stage = stages[s];
      copy(joint.accel, s, stage.gap_accel[j]);
      copy(joint.force, s, stage.force[j]);
      if (simple && s < N - 1) continue;
      copy(rate, s, stage.gap_rate[j]);
      copy(gap, s, stage.gap[j]);
    }
  }
  for (int s = 0; s < N; ++s) stages[s].loss = loss[s];
}

template <int N>
double LaneSolver<N>::residual(int j) const {
  const Joint& joint = joints_[j];
  L bias[3], e[3];
  find_map(j, bias).gather(bodies_[joint.a].a, bodies_[joint.b].a, e);
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double at_end = (joint.accel[k] - e[k] - bias[k])[N - 1];
    square += at_end * at_end;
  }
  return std::sqrt(square);
}

template <int N>
void LaneSolver<N>::find_yield(std::vector<Four>& forces) const {
  lu_.solve(forces);
  const double mu2 = mu2_.x[N - 1];
  for (Four& x : forces)
    for (int k = 0; k < 3; ++k) x[k] = mu2 * x[k];
}

namespace {

// The same text for registers of every width: everything that is made of lanes is inlined into these functions.
#define PINTLE_SOLVER(Name, WIDTH)                                                                                                            \
  template <int N>                                                                                                                            \
  class Name final : public LaneSolver<N> {                                                                                                   \
   public:                                                                                                                                    \
    using LaneSolver<N>::LaneSolver;                                                                                                          \
    WIDTH bool solve(const State& begin, double h, const StepNodes* before, double last_h, const LoadScale& scale, Counters& counters) override { \
      return this->solve_stages(begin, h, before, last_h, scale, counters);                                                                   \
    }                                                                                                                                         \
    WIDTH void yield_to(std::vector<Four>& forces) const override { this->find_yield(forces); }                                               \
    WIDTH void write(const State& begin, std::vector<Stage>& stages, StageTails& tails) const override { this->write_stages(begin, stages, tails); } \
  };

PINTLE_SOLVER(NarrowSolver, )
#ifdef PINTLE_WIDE
PINTLE_SOLVER(WideSolver, PINTLE_WIDE)
PINTLE_SOLVER(WidestSolver, PINTLE_WIDEST)
#endif
#undef PINTLE_SOLVER

template <int N>
std::unique_ptr<StageSolver> make_solver(const System& system, const RadauTable& table, double tolerance, Steps steps) {
#ifdef PINTLE_WIDE
  if (has_widest_registers()) return std::make_unique<WidestSolver<N>>(system, table, tolerance, steps);
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
