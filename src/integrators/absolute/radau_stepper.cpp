#include "integrators/absolute/radau_stepper.h"

#include <limits>
#include <utility>

namespace pintle {

using S = Planar;

RadauStepper::RadauStepper(const System& system, double tolerance, int stages, ToleranceOf tolerance_of)
    : system_(system), table_(RadauTable::of(stages)), n_(table_.n), tolerance_(tolerance), of_motion_(tolerance_of == ToleranceOf::kMotion), search_(system.switching()),
      solver_(make_stage_solver(system, table_, tolerance, of_motion_ ? Steps::kLong : Steps::kAccurate)), stage_(table_.n), end_point_(make_end_point_projection(system)),
      tails_{std::vector<Vec3x4>(system.bodies.size()), std::vector<Vec3x4>(system.joints.size()), std::vector<Lanes<4>>(system.n_law_states())}, end_m_(system.bodies.size()) {
  const std::size_t n = system.bodies.size(), m = system.joints.size();
  const Vecs bodies(n, S::Vec::Zero()), joints(m, S::Vec::Zero());
  const std::vector<double> states(system.n_law_states());
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].servo >= 0 || !system.joints[j].law.constant_diagonal()) powered_.push_back(j);
  const bool only_last = powered_.empty() && !system.has_loads();  // no other stage is asked for its power
  for (Stage& s : stage_) {
    s.a = bodies;
    s.gap_accel = s.force = joints;
    s.law_state = s.law_rate = states;
    if (only_last && &s != &stage_.back()) continue;
    s.q = s.v = s.Q = bodies;
    s.gap = s.gap_rate = joints;
    s.m.resize(n);
  }
  nodes_ = {&table_, std::vector<Vecs>(n_ + 1, bodies), std::vector<Vecs>(n_ + 1, joints), std::vector<Vecs>(n_ + 1, joints),
            std::vector<std::vector<double>>(n_ + 1, states), std::vector<std::vector<double>>(n_ + 1, states), std::vector<std::array<double, 2>>(n_ + 1)};
  scale_.body = bodies;
  if (!system.has_branches()) return;
  inside_q_ = inside_v_ = bodies;
  inside_gap_ = inside_rate_ = joints;
  inside_law_state_ = states;
  end_r_.resize(m);
}

bool RadauStepper::attempt(double h) {
  if (of_motion_) motion_scale_.update(system_, begin_, h);
  const LoadScale& scale = of_motion_ ? motion_scale_.loads() : scale_;
  if (!solver_->solve(begin_, h, control_.have_history ? &nodes_ : nullptr, control_.last, scale, counters_)) return false;
  solver_->write(begin_, stage_, tails_);
  return true;
}

void RadauStepper::start(const State& state, double h) {
  begin_ = end_ = state;
  control_.start(h);
  system_.motions(end_.q, end_.v, end_m_);
  Stage& last = stage_[n_ - 1];
  last.Q.assign(system_.bodies.size(), S::Vec::Zero());
  system_.external(end_.t, end_m_, last.Q, end_.sliding);
  find_power();
  chattering_.forget();
  if (system_.has_branches()) system_.find_switching(end_.t, end_m_, end_.gap, end_.gap_rate, end_.law_state, end_.sliding, search_.start());
  grow_load_scale(system_, end_m_, last.Q, end_, scale_);
  if (unloaded()) foresee_loads(h);
}

bool RadauStepper::unloaded() const {
  for (std::size_t i = 0; i < scale_.body.size(); ++i)
    if (scale_.body[i][0] > 1.001 * kLeastLoad * system_.bodies[i].mass[0]) return false;
  return !scale_.body.empty();
}

// Where nothing acts yet (joints that are not stretched), no force is large enough to measure errors by: the loads are those
// that the linearised first step finds.
void RadauStepper::foresee_loads(double h) {
  const double everything = std::numeric_limits<double>::max();
  const LoadScale any{Vecs(scale_.body.size(), S::Vec::Constant(everything))};
  if (!solver_->solve(begin_, h, nullptr, 0, any, counters_)) return;
  solver_->write(begin_, stage_, tails_);
  State ahead = end_;
  ahead.a = stage_[n_ - 1].a;
  ahead.force = stage_[n_ - 1].force;
  grow_load_scale(system_, end_m_, stage_[n_ - 1].Q, ahead, scale_);
}

bool RadauStepper::step(double t_end) {
  if (control_.advance(*this, t_end, tolerance_, n_ + 1, counters_)) return true;
  std::vector<std::pair<double, int>> residuals;
  for (int j = 0; j < system_.n_joints(); ++j) residuals.emplace_back(solver_->residual(j), j);
  failure_ = no_step_message(system_, begin_.t, control_.next, std::move(residuals), control_.last_event(system_, begin_.t - control_.usual));
  return false;
}

bool RadauStepper::trial(double h) {
  begin_ = end_;
  double error = 0;
  if (!attempt(h) || !error_estimate(h, error)) return false;
  finish_step(h);
  return true;
}

}  // namespace pintle
