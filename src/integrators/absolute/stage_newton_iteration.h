// The stage solver, for registers of several widths. Included where it is compiled, once for each space.
//
// Simplified Newton iteration on all stages at once: they occupy the lanes of Lanes<N>, and so do the real and complex
// systems into which their equations decouple.
#pragma once

#include "integrators/absolute/lane_stage_solver_guess.h"
#include "integrators/absolute/lane_stage_solver_laws.h"
#include "integrators/absolute/lane_stage_solver_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "integrators/absolute/pose_blocks.h"
#include "simd/processor_registers.h"

namespace pintle {

template <class S, int N>
LaneStageSolver<S, N>::LaneStageSolver(const BasicSystem<S>& system, const RadauTable& table, double tolerance, Steps steps)
    : system_(system), table_(table), matrices_(table), tolerance_(tolerance), predictor_(steps), loads_(system.has_loads()), large_(system.bodies.size() > kLargeMechanism),
      pattern_(system.pattern().in_order()), bodies_(system.bodies.size() + 1), joints_(system.joints.size()), Q_(system.bodies.size()), loads_on_(loads_ ? system.bodies.size() + 1 : 0),
      motions_(system.bodies.size()), lu_(pattern_, loads_ ? Symmetry::kNone : symmetry_of_joints(system)), rhs_(system.bodies.size() + 1) {
  bodies_.back().stand_still();  // the ground; forces on it are ignored
  for (std::size_t b = 0; b < n_bodies(); ++b) bodies_[b].index = system.pattern().row_at(static_cast<int>(b));
  const int ground = static_cast<int>(n_bodies());
  const auto body = [&](int index) { return index == kGround ? ground : system.pattern().position(index); };
  bool driven = false;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const BasicJointData<S>& data = system.joints[j];
    Joint& joint = joints_[j];
    joint.index = static_cast<int>(j);
    joint.a = body(data.at.a);
    joint.b = body(data.at.b);
    joint.first = std::min(joint.a, joint.b);
    joint.last = joint.a == ground || joint.b == ground ? joint.first : std::max(joint.a, joint.b);
    joint.functions = count_functions(data.displacement);
    joint.F = S::attachment(data.at.F);
    joint.M = S::attachment(data.at.M);
    joint.driven = static_cast<signed char>(data.driven);
    if (const BasicLinearLaw<S>* law = data.law.as_linear()) {
      joint.linear = true;
      for (int k = 0; k < S::kDof; ++k) {
        joint.k[k] = law->k[k];
        joint.c[k] = law->c[k];
      }
    } else {
      joint.general = static_cast<int>(general_.size());
      relinearizes_ = relinearizes_ || is_relinearized(data.law);
      General& general = general_.emplace_back();
      const int states = data.law.n_states();
      general.impedance.reserve(states);
      for (auto* x : {&general.state, &general.rate, &general.residual}) x->resize(states);
      general.missing_hat.resize(states);
      general.matrix.resize(N * states * N * states);
      general.move.resize(N * states);
    }
    joint.loses = joint.linear && data.driven < 0;
    simple_ = simple_ && joint.loses;
    poses_ = poses_ && joint.linear && joint.functions == 0;
    driven = driven || data.driven >= 0;
    if (data.at.a != kGround && data.at.b != kGround) joint.slot = pattern_.slot(joint.a, joint.b);
  }
  simple_ = simple_ && !loads_;
  std::stable_sort(joints_.begin(), joints_.end(), [](const Joint& i, const Joint& j) { return i.last < j.last; });
  by_first_.resize(large_ ? joints_.size() : 0);
  std::iota(by_first_.begin(), by_first_.end(), 0);
  std::stable_sort(by_first_.begin(), by_first_.end(), [this](int i, int j) { return joints_[i].first < joints_[j].first; });
  if (driven) target_accel_.assign(joints_.size(), L::all(0));
}

template <class S, int N>
bool LaneStageSolver<S, N>::solve_stages(const BasicState<S>& begin, double h, const BasicStepNodes<S>* before, double last_h, const BasicLoadScale<S>& scale,
                                 Counters& counters) {
  step_.scale(matrices_, h);
  const Curve curve(table_, predictor_, h, before, last_h);
  find_targets(begin.t, h);
  contraction_.start();
  // An old factorisation does not know the new side of a jump: without a previous step none can be reused.
  bool fresh = !before || h != factorized_for_ || contraction_.rate() > NewtonContraction::kGood, wanted = fresh;  // the factorisation is new; a new one is wanted
  const Curve* unplaced = &curve;  // null once the stages have been placed
  double first = -1;               // correction of this step, in tolerances
  for (int iteration = 0; iteration < NewtonContraction::kMaxIterations; ++iteration) {
    const bool eliminated = assemble_and_eliminate(begin, h, std::exchange(unplaced, nullptr), scale, wanted);
    counters.evaluations += N;
    if (wanted) counters.factorizations += 1 + N / 2;
    if (!eliminated) {
      factorized_for_ = 0;
      return false;
    }
    const double correction = back_substitute(begin);
    if (first < 0) first = correction / tolerance_;
    if (wanted) factorized_for_ = h;
    ++counters.newton_iterations;
    const auto verdict = contraction_.judge(iteration, correction, tolerance_);
    if (verdict == NewtonContraction::Verdict::kDone) {
      if (!begin.sliding.empty()) find_balanced_loads();
      else if (loads_ && correction > NewtonContraction::kShare * tolerance_) find_loads(begin, h);  // so far those before the last correction
      if (before && relinearizes_) predictor_.choose_degree(table_, h / last_h, first, [&](const RadauTable::Vec& weights) { return extrapolation_error(*before, weights); });
      return true;
    }
    const bool hopeless = verdict == NewtonContraction::Verdict::kHopeless;
    if (hopeless && fresh) return false;
    wanted = hopeless || (fresh ? relinearizes_ && contraction_.wants_new_jacobians() : iteration > 0 && (contraction_.rate() > kSlow || iteration > kMostWithOld));
    if (wanted && !fresh) {
      fresh = true;
      contraction_.start();
      iteration = -1;
    }
  }
  return false;
}

// Forward pass: the residuals of all equations, the matrix of the correction, and their elimination. Bodies and joints that follow
// each other are processed together, while they are in the cache; loads need the positions of all bodies. False where the matrix, if
// it has to be factorised, is singular. Eqs. (3.9), (3.10).
template <class S, int N>
bool LaneStageSolver<S, N>::assemble_and_eliminate(const BasicState<S>& begin, double h, const Curve* unplaced, const BasicLoadScale<S>& scale, bool linearized) {
  const bool whole = loads_ || !poses_;
  const auto complete = [&](int b, BlockVec<X, S::kDof>& x) {
    if (large_) {
      fetch(rhs_, b + kLater);
      if (linearized) lu_.fetch_row(b + static_cast<int>(kLater));
      if (!unplaced) fetch(bodies_, b + kLater);
    }
    for (int k = 0; k < S::kDof; ++k) x[k] += X(matrices_.T_inverse * bodies_[b].residual[k]);
  };
  if (linearized) begin_matrix(h);
  std::size_t j = 0;
  int row = 0;
  for (std::size_t first = 0, end = 0; first < n_bodies(); first = end) {
    end = whole ? n_bodies() : std::min(first + kTile, n_bodies());
    if (unplaced) begin_bodies(begin, *unplaced, scale, first, end);
    if (loads_) find_loads(begin, h);
    for (std::size_t b = first; b < end; ++b) {
      begin_residual(b);
      if (!linearized) continue;
      const typename S::Vec& mass = system_.bodies[bodies_[b].index].mass;
      lu_.set_diagonal(static_cast<int>(b), [&](int k) { return mass[k] * mu2_; });
    }
    if (linearized && whole) add_loads(begin, h);
    for (; j < joints_.size() && joints_[j].last < static_cast<int>(end); ++j) {
      Joint& joint = joints_[j];
      if (large_) fetch_joint(begin, unplaced, j);
      if (unplaced) begin_joint(begin, *unplaced, scale, joint);
      L bias[S::kDof];
      const typename S::template GapMap<L> map = find_map(joint, bias);
      if (linearized) linearize(begin, joint, map);
      assemble_joint(joint, map, bias);
    }
    const int ready = lu_.ready(static_cast<int>(end), row);
    if (!linearized) lu_.reduce(row, ready, rhs_, complete);
    else if (!lu_.eliminate(row, ready, rhs_, complete)) return false;
    row = ready;
  }
  return true;
}

template <class S, int N>
void LaneStageSolver<S, N>::place_body(const BasicState<S>& begin, std::size_t b) {
  Body& body = bodies_[b];
  body.place(step_, begin.q[body.index], begin.v[body.index]);
}

// `angles`: the largest ones.
template <class S, int N>
void LaneStageSolver<S, N>::check_angles(const L& angles, std::size_t first, std::size_t end) {
  if (!Body::must_check(angles)) return;
  for (std::size_t b = first; b < end; ++b) bodies_[b].check();
}

// The joint's force at its gaps and their rates. Updates `worst` and `sum` by its change, over the scale of the bodies that it acts on.
template <class S, int N>
void LaneStageSolver<S, N>::place_joint(const BasicState<S>& begin, Joint& joint, L& worst, L& sum) {
  const typename S::Vec &gap_there = begin.gap[joint.index], &rate_there = begin.gap_rate[joint.index];
  L gap[S::kDof], rate[S::kDof];
  for (int k = 0; k < S::kDof; ++k) gap[k] = step_.place(joint.accel[k], gap_there[k], rate_there[k], rate[k]);
  L of_law[S::kDof];
  if (!joint.linear) place_general(begin, joint, gap, rate, of_law);
  for (int k = 0; k < S::kDof; ++k) {
    const L force = joint.linear ? -(joint.k[k] * gap[k] + joint.c[k] * rate[k]) : of_law[k];
    const L change = joint.over_scale[k] * (force - joint.force[k]);
    worst = larger_size(worst, change);
    sum += change;
    joint.force[k] = force;
  }
}

// The residual of a body's equations without the joints' forces. Eq. (3.6).
template <class S, int N>
void LaneStageSolver<S, N>::begin_residual(std::size_t b) {
  const BasicBodyData<S>& data = system_.bodies[bodies_[b].index];
  for (int k = 0; k < S::kDof; ++k) {
    bodies_[b].residual[k] = (loads_ ? loads_on_[b][k] : L::all(data.gravity[k])) - data.mass[k] * bodies_[b].a[k];
    rhs_[b][k] = X(L::all(0));
  }
}

template <class S, int N>
void LaneStageSolver<S, N>::find_loads(const BasicState<S>& begin, double h) {
  for (int s = 0; s < N; ++s) {
    for (std::size_t b = 0; b < n_bodies(); ++b) motions_[bodies_[b].index] = bodies_[b].motion(s);
    system_.external(begin.t + table_.c[s] * h, motions_, Q_, begin.sliding);
    for (std::size_t b = 0; b < n_bodies(); ++b)
      for (int k = 0; k < S::kDof; ++k) loads_on_[b][k].set(s, Q_[bodies_[b].index][k]);
  }
}

// The loads that the last correction has assumed. The ramp of a motor that is held at a jump is so steep that the rounding of a
// velocity makes its effort less accurate than this.
template <class S, int N>
void LaneStageSolver<S, N>::find_balanced_loads() {
  for (std::size_t b = 0; b < n_bodies(); ++b)
    for (int k = 0; k < S::kDof; ++k) loads_on_[b][k] = system_.bodies[bodies_[b].index].mass[k] * bodies_[b].a[k];
  for (const Joint& joint : joints_) {
    L bias[S::kDof];
    L against[S::kDof];
    for (int k = 0; k < S::kDof; ++k) against[k] = -joint.force[k];
    find_map(joint, bias).push(against, loads_on_[joint.a], loads_on_[joint.b]);
  }
}

// Adds a joint's force to its bodies, and the effect on them of the residual of its own equation. Its acceleration becomes the
// one that follows from the bodies': the correction starts from there. Eq. (3.6).
template <class S, int N>
void LaneStageSolver<S, N>::assemble_joint(Joint& joint, const typename S::template GapMap<L>& map, const L (&bias)[S::kDof]) {
  Body &A = bodies_[joint.a], &B = bodies_[joint.b];
  map.push(joint.force, A.residual, B.residual);
  L e[S::kDof];
  X missing[S::kDof], f[S::kDof];
  map.gather(A.a, B.a, e);
  for (int k = 0; k < S::kDof; ++k) {
    e[k] += bias[k];
    missing[k] = X(matrices_.T_inverse * (joint.accel[k] - e[k]));
    joint.accel[k] = e[k];
  }
  if (joint.linear)
    for (int k = 0; k < S::kDof; ++k) f[k] = (joint.k[k] * twice_ + joint.c[k] * once_) * missing[k];
  else
    answer_states(general_[joint.general], missing, f);
  joint.frozen.push(f, rhs_[joint.a], rhs_[joint.b]);
}

// The map of a joint and its convective acceleration; in a driven component, minus the target's acceleration.
template <class S, int N>
typename S::template GapMap<Lanes<N>> LaneStageSolver<S, N>::find_map(const Joint& joint, L (&bias)[S::kDof]) const {
  const auto pose = S::template PoseGeometry<L>::between(bodies_[joint.a].view(), joint.F, bodies_[joint.b].view(), joint.M);
  typename S::template GapMap<L> map;
  map.functions = joint.functions;
  map.set(pose);
  pose.biases(bias);
  if (joint.functions > 0) find_gradients(joint, map, bias);
  if (joint.driven >= 0) bias[joint.driven] -= target_accel_[joint.index];
  return map;
}

// A gap of functions of the pose: gradients go into the map, convective accelerations into `bias`. theory/joints Eq. (2.14).
template <class S, int N>
void LaneStageSolver<S, N>::find_gradients(const Joint& joint, typename S::template GapMap<L>& map, L (&bias)[S::kDof]) const {
  const BasicJointData<S>& data = system_.joints[joint.index];
  const Body &A = bodies_[joint.a], &B = bodies_[joint.b];
  for (L& b : bias) b = L::all(0);
  for (int s = 0; s < N; ++s) {
    const typename S::RelativePose z = S::RelativePose::between(A.motion(s), data.at.F, B.motion(s), data.at.M);
    for_each_function(data.displacement, z.z, [&](int f, const BasicGapFunction<S>& g) {
      for (int k = 0; k < S::kDof; ++k) map.gradient[f][k].set(s, g.gradient[k]);
      bias[f].set(s, g.gradient.dot(z.bias) + z.rate.dot(g.hessian * z.rate));
    });
  }
}

// Backward pass: the corrections of bodies and joints, and the corrected motions. Eq. (3.11). Returns the size of the corrections: as
// body forces, and as changes of joint forces, over the scale.
template <class S, int N>
double LaneStageSolver<S, N>::back_substitute(const BasicState<S>& begin) {
  L worst = L::all(0), sum = worst, angles = worst;
  for (L& still : bodies_.back().residual) still = L::all(0);
  const auto move = [&](int b, const BlockVec<X, S::kDof>& x) {
    apply_body_correction(begin, b, x, worst, sum);
    angles = larger_size(angles, bodies_[b].to_check());
  };
  if (!large_) {
    lu_.substitute(0, pattern_.n(), rhs_, move);
    for (Joint& joint : joints_) apply_joint_correction(begin, joint, worst, sum);
  }
  std::size_t left = large_ ? joints_.size() : 0;
  for (int first = 0, end = large_ ? pattern_.n() : 0; end > 0; end = first) {
    first = std::max(0, end - static_cast<int>(kTile));
    lu_.substitute(first, end, rhs_, move);
    for (; left > 0 && joints_[by_first_[left - 1]].first >= first; --left) {
      if (left > kLater) {
        fetch(joints_, by_first_[left - 1 - kLater]);
        const int i = joints_[by_first_[left - 1 - kSoon]].index;
        fetch(begin.gap, i);
        fetch(begin.gap_rate, i);
      }
      apply_joint_correction(begin, joints_[by_first_[left - 1]], worst, sum);
    }
  }
  check_angles(angles, 0, n_bodies());
  return largest(worst, sum);
}

template <class S, int N>
void LaneStageSolver<S, N>::apply_joint_correction(const BasicState<S>& begin, Joint& joint, L& worst, L& sum) {
  L e[S::kDof];
  joint.frozen.gather(bodies_[joint.a].residual, bodies_[joint.b].residual, e);
  for (int k = 0; k < S::kDof; ++k) joint.accel[k] += e[k];
  if (!joint.linear) move_states(general_[joint.general], e);
  place_joint(begin, joint, worst, sum);
}

template <class S, int N>
void LaneStageSolver<S, N>::apply_body_correction(const BasicState<S>& begin, int b, const BlockVec<X, S::kDof>& x, L& worst, L& sum) {
  Body& body = bodies_[b];
  if (large_ && b >= static_cast<int>(kLater)) {
    fetch(bodies_, b - kLater);
    fetch(rhs_, b - kLater);
    lu_.fetch_upper(b - static_cast<int>(kLater));
    const int i = bodies_[b - kSoon].index;
    fetch(begin.q, i);
    fetch(begin.v, i);
  }
  for (int k = 0; k < S::kDof; ++k) {
    const L delta = back_ * x[k].x, relative = body.over_scale[k] * delta;
    body.residual[k] = delta;
    body.a[k] += delta;
    worst = larger_size(worst, relative);
    sum += relative;
  }
  place_body(begin, b);
}

// Prefetches what will soon be written of a body and of a joint.
template <class S, int N>
PINTLE_LANES void LaneStageSolver<S, N>::fetch_body_end(const BasicState<S>& begin, const std::vector<BasicStage<S>>& stages, const BasicStageTails<S>& tails, std::size_t b) const {
  fetch(bodies_, b + kSoon);
  if (b >= n_bodies()) return;
  const int i = bodies_[b].index;
  const BasicStage<S>& last = stages.back();
  fetch(begin.a, i);
  fetch(tails.bodies, i);
  for (const BasicStage<S>& stage : stages) fetch(stage.a, i);
  fetch(last.q, i);
  for (const VecsOf<S>* x : {&last.v, &last.Q}) fetch(*x, i);
  fetch(last.m, i);
}
template <class S, int N>
PINTLE_LANES void LaneStageSolver<S, N>::fetch_joint_end(const BasicState<S>& begin, const std::vector<BasicStage<S>>& stages, const BasicStageTails<S>& tails, std::size_t j) const {
  fetch(joints_, j + kSoon);
  if (j >= joints_.size()) return;
  const int i = joints_[j].index;
  const BasicStage<S>& last = stages.back();
  for (const VecsOf<S>* x : {&begin.gap, &begin.gap_rate, &last.gap, &last.gap_rate}) fetch(*x, i);
  fetch(tails.gaps, i);
  for (const BasicStage<S>& stage : stages) {
    fetch(stage.gap_accel, i);
    fetch(stage.force, i);
  }
}

template <class S, int N>
void LaneStageSolver<S, N>::write_stages(const BasicState<S>& begin, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const {
  const bool simple = simple_;
  const auto copy = [](const L* from, int s, typename S::Vec& to) {
    for (int k = 0; k < S::kDof; ++k) to[k] = from[k][s];
  };
  const auto put = [](const L& from, Lanes<4>& to) { to = Lanes<4>::of({from[0], from[1], from[2], 0}); };
  for (std::size_t b = 0; b < n_bodies(); ++b) {
    const Body& body = bodies_[b];
    const int i = body.index;
    if (large_) fetch_body_end(begin, stages, tails, b + kSoon);
    for (int s = 0; s < N; ++s) {
      BasicStage<S>& stage = stages[s];
      copy(body.a, s, stage.a[i]);
      if (simple && s < N - 1) continue;
      stage.q[i] = body.coordinates(s, begin.q[i]);
      copy(body.v, s, stage.v[i]);
      stage.m[i] = body.motion(s);
      if (loads_) copy(loads_on_[b].a.data(), s, stage.Q[i]);
      else stage.Q[i] = system_.bodies[i].gravity;
    }
    if constexpr (S::kCurved)
      for (int s = 0; s < N; ++s) body.write_increment_rate(s, stages[s].increment_rate[i]);
    for (int k = 0; k < S::kDof; ++k) put(begin.a[i][k] * matrices_.tail_of_start + matrices_.tail * body.a[k], tails.bodies[i][k]);
  }
  L loss = L::all(0);
  for (std::size_t at = 0; at < joints_.size(); ++at) {
    const Joint& joint = joints_[at];
    const int j = joint.index;
    if (large_) fetch_joint_end(begin, stages, tails, at + kSoon);
    L gap[S::kDof], rate[S::kDof];
    for (int k = 0; k < S::kDof; ++k) {
      gap[k] = step_.place(joint.accel[k], begin.gap[j][k], begin.gap_rate[j][k], rate[k]);
      put(matrices_.tail_of_stages * joint.accel[k], tails.gaps[j][k]);
    }
    if (joint.loses)
      for (int k = 0; k < S::kDof; ++k) loss += joint.c[k] * (rate[k] * rate[k]);
    if (!joint.linear) write_states(begin, joint, gap, rate, stages, tails);
    for (int s = 0; s < N; ++s) {
      BasicStage<S>& stage = stages[s];
      copy(joint.accel, s, stage.gap_accel[j]);
      copy(joint.force, s, stage.force[j]);
      if (simple && s < N - 1) continue;
      copy(rate, s, stage.gap_rate[j]);
      copy(gap, s, stage.gap[j]);
    }
  }
  for (int s = 0; s < N; ++s) stages[s].loss = loss[s];
}

template <class S, int N>
double LaneStageSolver<S, N>::residual(int j) const {
  const Joint& joint = *std::find_if(joints_.begin(), joints_.end(), [j](const Joint& other) { return other.index == j; });
  L bias[S::kDof], e[S::kDof];
  find_map(joint, bias).gather(bodies_[joint.a].a, bodies_[joint.b].a, e);
  double square = 0;
  for (int k = 0; k < S::kDof; ++k) {
    const double at_end = (joint.accel[k] - e[k] - bias[k])[N - 1];
    square += at_end * at_end;
  }
  return std::sqrt(square);
}

// Rows of the system in the order of elimination.
template <class S>
struct InOrder {
  RowOf4<S>* rows;
  const BlockPattern& pattern;
  InOrder data() const { return *this; }
  RowOf4<S>& operator[](int k) const { return rows[pattern.row_at(k)]; }
};

template <class S, int N>
void LaneStageSolver<S, N>::filter_lanes(std::vector<RowOf4<S>>& forces) const {
  InOrder<S> rows{forces.data(), system_.pattern()};
  lu_.solve(rows);
  const double mu2 = mu2_.x[N - 1];
  for (RowOf4<S>& x : forces)
    for (int k = 0; k < S::kDof; ++k) x[k] = mu2 * x[k];
}

// The same code for registers of every width: everything that works on lanes is inlined into these functions.
#define PINTLE_SOLVER(Name, WIDTH)                                                                                                            \
  template <class S, int N>                                                                                                                   \
  class Name final : public LaneStageSolver<S, N> {                                                                                              \
   public:                                                                                                                                    \
    using LaneStageSolver<S, N>::LaneStageSolver;                                                                                                \
    WIDTH bool solve(const BasicState<S>& begin, double h, const BasicStepNodes<S>* before, double last_h, const BasicLoadScale<S>& scale, Counters& counters) override { \
      return this->solve_stages(begin, h, before, last_h, scale, counters);                                                                   \
    }                                                                                                                                         \
    WIDTH void filter_accelerations(std::vector<RowOf4<S>>& forces) const override { this->filter_lanes(forces); }                               \
    WIDTH void write(const BasicState<S>& begin, std::vector<BasicStage<S>>& stages, BasicStageTails<S>& tails) const override { this->write_stages(begin, stages, tails); } \
  };

PINTLE_SOLVER(NarrowSolver, )
PINTLE_SOLVER(WideSolver, PINTLE_WIDE)
PINTLE_SOLVER(WidestSolver, PINTLE_WIDEST)
#undef PINTLE_SOLVER

template <class S, int N>
std::unique_ptr<BasicStageSolver<S>> make_solver(const BasicSystem<S>& system, const RadauTable& table, double tolerance, Steps steps) {
  using Widest = std::conditional_t<S::kCurved, WideSolver<S, N>, WidestSolver<S, N>>;  // in space it takes long to compile, and gains little
  return make_for_processor<BasicStageSolver<S>, NarrowSolver<S, N>, WideSolver<S, N>, Widest>(system, table, tolerance, steps);
}

template <class S>
std::unique_ptr<BasicStageSolver<S>> make_stage_solver(const BasicSystem<S>& system, const RadauTable& table, double tolerance, Steps steps) {
  if (table.n == 5) return make_solver<S, 5>(system, table, tolerance, steps);
  return make_solver<S, 3>(system, table, tolerance, steps);
}

}  // namespace pintle
