#include "integrators/ideal/ideal_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrators/dormand_prince.h"
#include "integrators/thresholds.h"
#include "system/target_jumps.h"

namespace pintle {
namespace {

using S = Planar;
using namespace dormand_prince;

constexpr double kLongest = 4;           // upper limit, as a multiple of the last step away from singular positions: near them the error that counts may be almost zero
constexpr double kCrossing = 0.1;        // fraction of the tolerance times the usual step: a step this short is taken across a jump of a force
constexpr double kNearJump = 1e-4;       // fraction of the usual step: rejected steps this short are checked for jumps
constexpr double kLeastCrossing = 1e-8;  // lower limit on such steps, as a fraction of the usual step: shorter ones are lost in the rounding of velocities over the step

// The largest of two stages' velocities or accelerations: (along, along, turn).
S::Vec largest_rates(const Vecs& start, const Vecs& end) {
  double turn = 0;
  for (const Vecs* x : {&start, &end})
    for (const S::Vec& xi : *x) turn = std::max(turn, std::abs(xi[2]));
  const double along = std::max(largest_coordinate(start), largest_coordinate(end));
  return {along, along, turn};
}

}  // namespace

IdealStepper::IdealStepper(const System& system, double tolerance, Equations equations, const PenaltySettings& penalty)
    : system_(system), projects_(equations == Equations::kIdeal), tolerance_(tolerance), equations_(system, equations, penalty), bends_(system), dense_(system) {
  for (auto* k : {&kq_, &kv_})
    for (auto& x : *k) x.resize(system.bodies.size());
  scale_.body.assign(system.bodies.size(), S::Vec::Zero());
}

void IdealStepper::start(const State& state, double h) {
  end_ = state;
  h_ = smooth_h_ = usual_h_ = h;
  const double before = system_.kinetic(end_.v);
  if (!(projects_ ? onto_constraints(end_) : close_loops(system_, end_) && equations_.complete(end_))) failure_ = "ideal joints cannot be closed at the start: the loops do not close, or the position is singular";
  if (projects_) equations_.measure_misfit(end_.t, end_.q);
  const double lost = before - system_.kinetic(end_.v);
  if (lost > 1e-6 * before)
    remarks_.push_back(fmt::format("ideal joints: the stated velocities are inconsistent; an impulse in the joints dissipates {:.3g} J at the start", lost));
  begin_ = inside_ = stage_ = end_;
  for (Vecs* x : {&jerk_, &error_q_, &error_v_}) x->assign(end_.a.size(), S::Vec::Zero());
  most_independent_ = independence_ = projects_ ? equations_.independence(end_.t, end_.q) : 1;
  accurate_.clear();
  keep_accurate();
  grow_scale();
  foresee_loads(h);
  raise_above_rounding();
}

// No step can resolve less than the roundoff in the forces of joints that keep their laws, such as a belt that is taut without load.
void IdealStepper::raise_above_rounding() {
  std::vector<S::Motion> m;
  std::vector<JointKinematics> r;
  system_.motions(end_.q, end_.v, m);
  system_.joint_kinematics(end_.t, m, r);
  Vecs rounding(system_.bodies.size(), S::Vec::Zero());
  for (std::size_t j = 0; j < r.size(); ++j) {
    const JointData& joint = system_.joints[j];
    if (joint.ideal || joint.law.feeds()) continue;
    const S::Vec force = kLastBits * largest_coordinate(end_.q) * joint.law.engaged_stiffness();
    if (joint.at.a != kGround) rounding[joint.at.a] += r[j].GA().cwiseAbs().transpose() * force;
    if (joint.at.b != kGround) rounding[joint.at.b] += r[j].GB().cwiseAbs().transpose() * force;
  }
  for (std::size_t i = 0; i < rounding.size(); ++i) raise_scale(system_.bodies[i], S::Vec(rounding[i] / tolerance_), scale_.body[i]);
}

// If almost nothing acts yet, as with a motor that is switched on slowly, no force is large enough as a reference for errors: the loads are then those of
// the first step.
void IdealStepper::foresee_loads(double h) {
  std::vector<S::Motion> m;
  system_.motions(end_.q, end_.v, m);
  Vecs Q(system_.bodies.size(), S::Vec::Zero());
  system_.external(end_.t + h, m, Q);
  for (std::size_t i = 0; i < Q.size(); ++i)
    if (Q[i].allFinite()) raise_scale(system_.bodies[i], S::Vec(Q[i].cwiseAbs()), scale_.body[i]);
}

bool IdealStepper::step(double t_end) {
  if (!failure_.empty()) return false;
  begin_ = end_;
  system_.motions(begin_.q, begin_.v, begin_m_);
  double wanted = max_step_ > 0 ? std::min(h_, max_step_) : h_, stop = t_end;
  bool at_once = true, jump_ahead = false, around = true;
  const double rounding = std::numeric_limits<double>::epsilon() * std::abs(t_end);
  const double crossing_h = std::max(std::max(kCrossing * tolerance_, kLeastCrossing) * smooth_h_, 1e3 * rounding);
  while (true) {
    const double left = stop - begin_.t, h = std::min(around ? step_around_singular_position(wanted) : wanted, left);
    if (h <= 16 * rounding) {
      failure_ = fmt::format("ideal joints: the step size became too small at t = {:.9g} s{}", begin_.t,
                             is_too_near(least_independence_) ? ", near a position where the constraints are not independent" : "");
      if (jump_ >= 0 && begin_.t - jump_t_ <= smooth_h_)
        failure_ += fmt::format("; {} is crossed again and again. Only equations = \"newtonian\" can hold a motor or force at the point where it switches", system_.name(system_.switching_functions()[static_cast<std::size_t>(jump_)]));
      return false;
    }
    const double e = take_stages(h) ? error(h) / tolerance_ : std::numeric_limits<double>::infinity();
    const double factor = step_ratio(e);
    if (e > 1 && h < kNearJump * smooth_h_ && std::isfinite(e)) jump_ahead = find_jump(h) || jump_ahead;
    // Across the jump, or up to where only roundoff is left of the distance to it.
    const bool crossing = e > 1 && h < crossing_h && std::isfinite(e) && jump_ahead;
    const bool shortest = h < 2 * clear_h_ && std::isfinite(e);  // that a step over the singular position may be
    const bool good = e <= 1 || crossing || shortest;
    if (const double seen = good ? share_of_step(h, t_end) : 1; seen < 1) {
      ++counters_.rejected;
      find_jump(h);
      wanted = h * seen;
      continue;
    }
    const double end = end_of_step(begin_.t, h, stop);
    if (const auto jump = good ? first_target_jump(system_, begin_.t, end) : std::nullopt) {  // end the step there
      if (jump->t <= begin_.t + 16 * rounding) {
        failure_ = infinite_force_message(*jump, system_.joints[static_cast<std::size_t>(jump->joint)]);
        return false;
      }
      stop = jump->t;
      continue;
    }
    if (good && finish(end, h)) {
      h_ = crossing ? kCrossing * smooth_h_ : h * factor;
      if (closed_) h_ = std::min(h_, kLongest * usual_h_);
      else if (!crossing) usual_h_ = h;
      if (at_once) smooth_h_ = std::max(h, kForget * smooth_h_);  // steps that approach a jump are short because of it
      return true;
    }
    ++counters_.rejected;
    at_once = false;
    if (!std::isfinite(e)) {  // a step over a singular position cannot be shortened
      around = false;
      clear_h_ = 0;
    }
    wanted = h * std::min(factor, 0.5);
  }
}

// Along the straight line from the start of the step to its last stage.
double IdealStepper::share_of_step(double h, double t_end) {
  system_.motions(stage_.q, stage_.v, stage_m_);
  return bends_.share_of_step(begin_.t, h, t_end, begin_m_, stage_m_);
}

// Whether the step crosses a switching function, or starts at its zero. The embedded error of a jump does not fall with the step; its effect on velocities does.
// A step may start at a jump, as that of t = 0 does where a motor starts.
// Whether a jump lies between the start of a step of h and its last stage. One that only earlier stages cross is remembered as well: the force drives
// the motion back at once.
bool IdealStepper::find_jump(double h) {
  if (!system_.has_branches()) return false;
  const auto side = [this](const State& state) {
    std::vector<S::Motion> m;
    system_.motions(state.q, state.v, m);
    std::vector<double> value(system_.switching_functions().size());
    system_.evaluate_switching_functions(state.t, m, state.gap, state.gap_rate, state.law_state, state.sliding, value.data());
    return value;
  };
  const std::vector<double> from = side(begin_);
  const auto find = [&](const State& state) {
    const std::vector<double> to = side(state);
    for (std::size_t f = 0; f < from.size(); ++f)
      if (from[f] == 0 || !same_sides(std::span(&from[f], 1), std::span(&to[f], 1))) {
        jump_ = static_cast<int>(f);
        jump_t_ = begin_.t;
        return true;
      }
    return false;
  };
  if (find(stage_)) return true;
  State between = begin_;
  for (int s = 1; s + 1 < kStages; ++s) {
    compute_stage_values(s, h, between);
    if (find(between)) break;
  }
  return false;
}

void IdealStepper::compute_stage_values(int s, double h, State& stage) const {
  stage.t = begin_.t + kC[s] * h;
  for (std::size_t i = 0; i < stage.q.size(); ++i) {
    S::Vec q = S::Vec::Zero(), v = S::Vec::Zero();
    for (int k = 0; k < s; ++k) {
      q += kA[s][k] * kq_[k][i];
      v += kA[s][k] * kv_[k][i];
    }
    stage.q[i] = begin_.q[i] + h * q;
    stage.v[i] = begin_.v[i] + h * v;
  }
}

// Puts the stage on the branch of the motion, where it has the same component along the branch's tangent at the start of the step. The nearest
// closed position may be on another branch, or distorted by it; Taylor's series leads to one on this branch. theory/ideal Eq. (3.3).
bool IdealStepper::onto_branch() {
  constexpr int kPasses = 3;  // projections of a stage onto its branch of the motion
  const double after = stage_.t - begin_.t;
  branch_ = begin_.q;
  for (std::size_t i = 0; i < branch_.size(); ++i) branch_[i] += after * (begin_.v[i] + after * (begin_.a[i] / 2 + after * jerk_[i] / 6));
  Vecs away(branch_.size());
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t i = 0; i < away.size(); ++i) away[i] = stage_.q[i] - branch_[i];
    at_begin_->project_onto_tangent(away);
    for (std::size_t i = 0; i < away.size(); ++i) branch_[i] += away[i];
    if (!equations_.close_positions(stage_.t, branch_)) return false;
  }
  stage_.q = branch_;
  return equations_.close_velocities(stage_.t, stage_.q, stage_.v) && equations_.complete(stage_);
}

// Towards a singular position the rates of states with open loops grow without bound; those on the branch of the motion do
// not. So every stage is closed there.
bool IdealStepper::take_stages(double h) {
  const double suspicious = kSuspicious * most_independent_;
  closed_ = is_near_singular_position();
  if (closed_) return find_tangent() && evaluate_stages(h);
  if (!evaluate_stages(h)) return false;
  if (least_independence_ > suspicious || independence_ < suspicious) return true;
  closed_ = true;
  return find_tangent() && evaluate_stages(h);
}

// The tangent of the branch at the start of the step, with equations of its own: the others are in use for the stages.
bool IdealStepper::find_tangent() {
  if (!at_begin_) {
    at_begin_ = std::make_unique<IdealEquations>(system_);
    at_begin_->take_misfit(equations_);
  }
  return at_begin_->find_tangent(begin_.t, begin_.q);
}

bool IdealStepper::evaluate_stages(double h) {
  least_independence_ = independence_;
  kq_[0] = begin_.v;
  kv_[0] = begin_.a;
  power_[0] = {begin_.supply_power, begin_.loss_power};
  for (int s = 1; s < kStages; ++s) {
    compute_stage_values(s, h, stage_);
    ++counters_.evaluations;
    ++counters_.factorizations;
    if (closed_ ? !onto_branch() : !equations_.complete(stage_)) return false;
    if (projects_) least_independence_ = std::min(least_independence_, equations_.independence());
    kq_[s] = stage_.v;
    kv_[s] = stage_.a;
    power_[s] = {stage_.supply_power, stage_.loss_power};
  }
  return true;
}

bool IdealStepper::onto_constraints(State& state) {
  return equations_.close_positions(state.t, state.q) && equations_.close_velocities(state.t, state.q, state.v) && equations_.complete(state);
}

// The last stage is at the end of the step. It is projected onto the constraints, except where branches of the motion meet: the
// nearest point may be on the wrong one.
bool IdealStepper::finish(double t, double h) {
  end_.t = t;
  end_.q = stage_.q;
  end_.v = stage_.v;
  if (!projects_ || is_too_near(least_independence_) ? !equations_.complete(end_) : !onto_constraints(end_)) return false;
  end_.supplied = begin_.supplied;
  end_.dissipated = begin_.dissipated;
  for (int s = 0; s < kStages - 1; ++s) {
    end_.supplied += h * kA[kStages - 1][s] * power_[s][0];
    end_.dissipated += h * kA[kStages - 1][s] * power_[s][1];
  }
  ++counters_.steps;
  for (std::size_t i = 0; i < jerk_.size(); ++i) jerk_[i] = (end_.a[i] - begin_.a[i]) / h;
  grow_scale();
  if (!projects_) {
    equations_.measure_violation();
    return true;
  }
  look_for_singular_position();
  keep_accurate();
  return true;
}

// The embedded error as a load: the one that would cause it as an acceleration over the step, relative to the loads of the body. If stages are
// closed, only the part that moves the mechanism counts: the rest is closed again, and grows towards a singular position.
double IdealStepper::error(double h) {
  for (std::size_t i = 0; i < error_q_.size(); ++i) {
    error_q_[i].setZero();
    error_v_[i].setZero();
    for (int s = 0; s < kStages; ++s) {
      error_q_[i] += kE[s] / h * kq_[s][i];
      error_v_[i] += kE[s] * kv_[s][i];
    }
  }
  if (closed_) {
    at_begin_->project_onto_tangent(error_q_);
    at_begin_->project_onto_tangent(error_v_);
  }
  double worst = 0;
  const S::Vec velocity = largest_rates(begin_.v, kq_[kStages - 1]), centripetal = velocity[2] * velocity[2] * S::Vec(largest_coordinate(begin_.q), largest_coordinate(begin_.q), 1);
  const S::Vec of_velocities = kLastBits / h * velocity, of_accelerations = kLastBits * largest_rates(begin_.a, kv_[kStages - 1]).cwiseMax(centripetal);  // roundoff
  const auto above = [](const S::Vec& x, const S::Vec& rounding) { return S::Vec((x.cwiseAbs() - rounding).cwiseMax(0)); };
  for (std::size_t i = 0; i < error_q_.size(); ++i) {
    const S::Vec d = above(error_v_[i], of_accelerations).cwiseMax(above(error_q_[i], of_velocities)).cwiseProduct(system_.bodies[i].mass).cwiseQuotient(scale_.body[i]);
    worst = std::max(worst, d.maxCoeff());
    if (!std::isfinite(d.sum())) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

void IdealStepper::grow_scale() {
  double largest = 0;
  for (int i = 0; i < system_.n_bodies(); ++i) largest = std::max({largest, scale_.body[i][0], system_.bodies[i].mass[0] * end_.a[i].head<2>().norm()});
  largest = std::max(largest, largest_force(end_.force));
  for (int i = 0; i < system_.n_bodies(); ++i) {
    const S::Vec& mass = system_.bodies[i].mass;
    const S::Vec load = mass.cwiseProduct(end_.a[i]).cwiseAbs() + system_.bodies[i].gravity.cwiseAbs();
    const double least = std::max(1e-9 * mass[0], kNegligible * largest);
    const double force = std::max({scale_.body[i][0], load[0], load[1], least});
    scale_.body[i] << force, force, std::max({scale_.body[i][2], load[2], 1e-3 * force * system_.bodies[i].radius_of_gyration()});
  }
  for (int j = 0; j < system_.n_joints(); ++j)
    for (const int body : {system_.joints[j].at.a, system_.joints[j].at.b}) {
      if (body == kGround) continue;
      const double force = std::max(scale_.body[body][0], end_.force[j].head<2>().norm());
      scale_.body[body] << force, force, std::max(scale_.body[body][2], std::abs(end_.force[j][2]));
    }
}

const State& IdealStepper::interpolate(double t) {
  inside_ = dense_.at(t, begin_, end_);
  if (!projects_) {
    equations_.complete(inside_);
    return inside_;
  }
  const bool independent = equations_.independence(t, inside_.q) > kFewDigits * most_independent_;
  if (independent && onto_constraints(inside_)) return inside_;
  equations_.complete(inside_);
  if (!independent) interpolate_forces(inside_);
  return inside_;
}

std::vector<std::string> IdealStepper::remarks() const {
  std::vector<std::string> all = remarks_;
  if (!projects_) all.push_back(equations_.violation_text("penalties"));
  return all;
}

}  // namespace pintle
