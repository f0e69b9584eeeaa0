#include "integrators/absolute/radau_stepper.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "integrators/thresholds.h"

namespace pintle {

template <class S>
BasicRadauStepper<S>::BasicRadauStepper(const BasicSystem<S>& system, double tolerance, int stages, ToleranceOf tolerance_of)
    : Events(system), system_(system), table_(RadauTable::of(stages)), n_(table_.n), tolerance_(tolerance), of_motion_(tolerance_of == ToleranceOf::kMotion),
      solver_(make_stage_solver(system, table_, tolerance, of_motion_ ? Steps::kLong : Steps::kAccurate)), stage_(table_.n), end_point_(make_end_point_projection(system)),
      tails_{std::vector<RowOf4<S>>(system.bodies.size()), std::vector<RowOf4<S>>(system.joints.size()), std::vector<RowOf4<S>>(system.n_law_states() > 0 ? system.joints.size() : 0)}, open_contacts_(system), force_tail_(system, all_joints(system)), bends_(system), end_m_(system.bodies.size()) {
  const std::size_t n = system.bodies.size(), m = system.joints.size();
  const VecsOf<S> bodies(n, S::Vec::Zero()), joints(m, S::Vec::Zero());
  const std::vector<double> states(system.n_law_states());
  for (int j = 0; j < system.n_joints(); ++j)
    if (system.joints[j].driven >= 0 || !system.joints[j].law.as_linear()) powered_.push_back(j);
  const bool only_last = powered_.empty() && !system.has_loads();  // no other stage's power is needed
  for (BasicStage<S>& s : stage_) {
    s.a = bodies;
    s.gap_accel = s.force = joints;
    s.law_state = s.law_rate = states;
    if (only_last && &s != &stage_.back()) continue;
    s.q.assign(n, S::at_origin());
    s.v = s.Q = bodies;
    if (S::kCurved) s.increment_rate = bodies;
    s.gap = s.gap_rate = joints;
    s.m.resize(n);
  }
  nodes_ = {&table_, std::vector<VecsOf<S>>(n_ + 1, bodies), std::vector<VecsOf<S>>(n_ + 1, joints), std::vector<VecsOf<S>>(n_ + 1, joints),
            std::vector<std::vector<double>>(n_ + 1, states), std::vector<std::vector<double>>(n_ + 1, states), std::vector<std::array<double, 2>>(n_ + 1)};
  if (S::kCurved) {
    nodes_.increment_rate.assign(n_ + 1, bodies);
    nodes_.increment_bend = bodies;
  }
  scale_.body = bodies;
  if (system.has_loads()) load_change_ = bodies;
  if (!system.has_branches()) return;
  inside_q_.assign(n, S::at_origin());
  inside_v_ = bodies;
  inside_gap_ = inside_rate_ = joints;
  inside_law_state_ = states;
  end_r_.resize(m);
}

template <class S>
bool BasicRadauStepper<S>::attempt(double h) {
  if (of_motion_) motion_scale_.update(system_, begin_, h);
  const BasicLoadScale<S>& scale = of_motion_ ? motion_scale_.loads() : scale_;
  if (!solver_->solve(begin_, h, control_.have_history ? &nodes_ : nullptr, control_.last, scale, counters_)) return false;
  solver_->write(begin_, stage_, tails_);
  return true;
}

template <class S>
void BasicRadauStepper<S>::start(const BasicState<S>& state, double h) {
  begin_ = end_ = state;
  load_change_ = loads_then_ = before_rebalancing_ = rounding_ = VecsOf<S>(system_.bodies.size(), S::Vec::Zero());
  control_.start(h);
  system_.motions(end_.q, end_.v, end_m_);
  BasicStage<S>& last = stage_[n_ - 1];
  last.Q.assign(system_.bodies.size(), S::Vec::Zero());
  system_.external(end_.t, end_m_, last.Q, end_.sliding);
  find_power();
  this->reset_event_detection();
  before_compensation_ = end_;
  grow_load_scale(system_, end_m_, last.Q, end_, scale_);
  if (unloaded()) foresee_loads(h);
  raise_above_rounding();
}

// Loads on a body below the rounding of the stiffest joint's force count as none, and no step resolves a part of them.
template <class S>
void BasicRadauStepper<S>::raise_above_rounding() {
  const double far = largest_coordinate(end_.q);
  typename S::Vec rounding = S::Vec::Constant(kLastBits * largest_stiffness(system_) * far);
  rounding.template tail<S::kDof - S::kDim>() *= far;  // at the mechanism's arms
  for (std::size_t i = 0; i < scale_.body.size(); ++i)
    if (scale_.body[i][0] <= rounding[0]) raise_load_scale_above_rounding(static_cast<int>(i), rounding);
  raise_above_rounding_of_servos();
  if (!system_.has_loads()) return;
  VecsOf<S> of_springs(system_.bodies.size(), S::Vec::Zero());
  system_.external_tangents(end_.t, end_m_, [&](int i, int, const typename S::Mat& dq, const typename S::Mat&) { of_springs[static_cast<std::size_t>(i)] += kLastBits * far * dq.cwiseAbs().rowwise().sum(); }, end_.sliding);
  for (std::size_t i = 0; i < of_springs.size(); ++i) raise_load_scale_above_rounding(static_cast<int>(i), of_springs[i]);
}

// For a coordinate that grows as the motor turns.
template <class S>
void BasicRadauStepper<S>::raise_above_rounding_of_servos() {
  for (const int j : powered_) {
    const BasicJointData<S>& joint = system_.joints[j];
    if (joint.servo < 0) continue;
    const double rounding = kLastBits * joint.law.engaged_stiffness()[joint.servo] * std::abs(target_of(joint, end_.t)[0]);
    typename S::Vec load = S::Vec::Zero();
    if (joint.servo < S::kDim) load.template head<S::kDim>().setConstant(rounding);
    else load.template tail<S::kDof - S::kDim>().setConstant(rounding);
    for (const int body : {joint.at.a, joint.at.b})
      if (body != kGround) raise_load_scale_above_rounding(body, load);
  }
}

template <class S>
void BasicRadauStepper<S>::raise_load_scale_above_rounding(int body, const typename S::Vec& rounding) {
  raise_scale(system_.bodies[body], typename S::Vec(rounding / tolerance_), scale_.body[body]);
}

template <class S>
bool BasicRadauStepper<S>::unloaded() const {
  for (std::size_t i = 0; i < scale_.body.size(); ++i)
    if (scale_.body[i][0] > 1.001 * kLeastLoad * system_.bodies[i].mass[0]) return false;
  return !scale_.body.empty();
}

// Where nothing acts yet (joints that are not stretched), no force is large enough to measure errors by: the loads are then
// those that the linearised first step finds.
template <class S>
void BasicRadauStepper<S>::foresee_loads(double h) {
  const double everything = std::numeric_limits<double>::max();
  const BasicLoadScale<S> any{VecsOf<S>(scale_.body.size(), S::Vec::Constant(everything))};
  if (!solver_->solve(begin_, h, nullptr, 0, any, counters_)) return;
  solver_->write(begin_, stage_, tails_);
  BasicState<S> ahead = end_;
  ahead.a = stage_[n_ - 1].a;
  ahead.force = stage_[n_ - 1].force;
  grow_load_scale(system_, end_m_, stage_[n_ - 1].Q, ahead, scale_);
}

template <class S>
bool BasicRadauStepper<S>::step(double t_end) {
  if (control_.advance(*this, t_end, tolerance_, n_ + 1, counters_)) return true;
  std::vector<std::pair<double, int>> residuals;
  for (int j = 0; j < system_.n_joints(); ++j) residuals.emplace_back(solver_->residual(j), j);
  failure_ = no_step_message(system_, begin_, control_.next, std::move(residuals), control_.last_event(system_, begin_.t - control_.usual));
  return false;
}

template <class S>
bool BasicRadauStepper<S>::trial(double h) {
  begin_ = end_;
  double error = 0;
  if (!attempt(h) || !error_estimate(h, error)) return false;
  finish_step(h);
  return true;
}

template class BasicRadauStepper<Planar>;
PINTLE_IN_SPACE(template class BasicRadauStepper<Spatial>;)

}  // namespace pintle
