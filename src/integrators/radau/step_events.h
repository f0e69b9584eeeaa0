// Steps that end where a law or a load has a kink or a jump: located on the step's own curve, approached from before, and crossed by a
// step too short to matter. The same for free bodies and over a joint tree. theory/time section 7.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "integrators/law_crossings.h"
#include "integrators/radau/sliding_mode.h"
#include "integrators/radau/step_control.h"
#include "system/target_jumps.h"

namespace pintle {

/// Upper limit, as a fraction of the loads and no more than the tolerance of the steps, on the change of joint forces on the way to an event that is crossed with the accelerations
/// at the start of this way: a joint that breaks away is loaded most just before it does, and no step sees the load that it gains on this way. Without it an elastic contact a
/// ten-thousandth as long as the flight before it gains a tenth of its energy. With 1e-4 a lever that leaves its stop after a jump of its motor does so at a time that varies by
/// more than its tolerance of 1e-8 allows; with 1e-5 and 1e-6 it does not, and takes no more steps.
constexpr double kMostForceChange = 1e-5;
constexpr double kLeastForceChange = 1e-9;  // lower limit, however small the tolerance. With twice it the runners of tests/models/runners_on_a_track.toml miss a tolerance of 1e-8; smaller values gain nothing
inline double most_force_change(double tolerance) { return std::clamp(tolerance, kLeastForceChange, kMostForceChange); }
/// Fraction of the distance to an event at which forces are evaluated, since they may jump at the event.
constexpr double kShareBeforeEvent = 0.999;

/// `Method` derives from it and provides
///   evaluate_switching_functions(x, h, value)                 the switching functions at share x of the step, on the curve through its stages
///   forces_stay_constant(d)                     whether joint forces change negligibly until then, so that Taylor's series is valid
///   extrapolate_switching_functions(d, value)   a time d after the start, by Taylor's series: the only source where the stages are not solved
///   evaluate_switching_functions_at_end(value)
///   end_time(), end_motions(), end_state(), sliding()
///   extrapolate_end_state(d)                    the end, its work included, by Taylor's series
///   motions_after(d)                            those a time d after the end
///   cross_borders()                             System::cross_borders between the values of `search_`
///   shift_gap(joint, d, rate)                   shifts the carried gap of a driven joint at the end, and its rate; what the law then stores more counts as supplied
///   taylor_step(d)                              a step of d by Taylor's series, with constant forces
///   balance_end()                               renews what laws and loads give at the end: forces, accelerations, powers
///   rebalance_end()                             balance_end(); if accelerations change only by the rounding of joint forces, raises the load scale above it
///   compensate_late_crossing(late)              for an event that was a time `late` before the end: applies the forces that act only after it for that time
///   undo_compensation()                         restores the end as it was before `compensate_late_crossing`
template <class Method, class S>
class StepEvents {
 protected:
  explicit StepEvents(const BasicSystem<S>& system)
      : search_(system.switching_functions()), events_of_(system), motions_before_(system.has_branches() ? system.bodies.size() : 0) {}

  void reset_event_detection();
  SwitchingEvent locate_event(double h, bool solved);
  /// Whether a law sets its states there.
  bool sets_states(const SwitchingEvent& event) const { return events_of_.switching_functions()[static_cast<std::size_t>(event.function)].law_has_states; }
  /// Whether no body moves in a step of h by more than the rounding of its position leaves open.
  bool rests(double h);
  /// Whether the bodies' motion within h is lost in the rounding of their positions: a shorter step then gets no closer to the event.
  bool motion_is_below_rounding(double h);
  /// Crosses the event `distance` after the end and renews forces and accelerations there. A jump that is crossed back at once is held.
  void cross_event(double distance, const SwitchingEvent& event);
  /// At the end of a step: releases a ramp that the last bits have left, and crosses a border that they have crossed.
  void update_switching();

  /// The end of the last step before the borders that its last bits have crossed, where forces may jump.
  const BasicState<S>& end_before_borders() const { return border_crossed_ ? before_borders_ : static_cast<const Method&>(*this).end_state(); }

  /// The state for times between the last event that was crossed at a step's start and the end of its crossing, where an output row may lie: the curve after the
  /// event does not lead back there. Null: t [s] is not in between.
  const BasicState<S>* in_crossing(double t);

  StepControl control_;
  EventSearch search_;
  std::vector<LawCrossing> crossings_;
  int sliding_load_ = -1;  // the first load held at a jump

 private:
  void compensate_late_crossing(double late, int function);
  Method& method() { return static_cast<Method&>(*this); }
  void restart_search() { method().evaluate_switching_functions_at_end(search_.start()); }
  double margin_rate(const SlidingMode& jump);
  void record() { record_crossings(events_of_, method().end_state(), search_.start(), search_.end(), crossings_); }

  const BasicSystem<S>& events_of_;
  BasicChatteringDetector<S> chattering_;
  std::vector<typename S::Motion> motions_before_;
  BasicState<S> before_borders_, before_crossing_, in_crossing_;
  bool has_crossed_ = false;
  bool border_crossed_ = false;
};

template <class Method, class S>
void StepEvents<Method, S>::reset_event_detection() {
  chattering_.forget();
  border_crossed_ = false;
  has_crossed_ = false;
  if (!events_of_.has_branches()) return;
  before_borders_ = before_crossing_ = in_crossing_ = method().end_state();
  restart_search();
}

// Continues the motion before the event.
template <class Method, class S>
const BasicState<S>* StepEvents<Method, S>::in_crossing(double t) {
  if (!has_crossed_ || !(t < method().t()) || !(t >= before_crossing_.t)) return nullptr;
  BasicState<S>& at = in_crossing_ = before_crossing_;
  const double d = t - at.t;
  at.t = t;
  for (std::size_t b = 0; b < at.q.size(); ++b) {
    S::move(at.q[b], d * at.v[b] + 0.5 * d * d * at.a[b]);
    at.v[b] += d * at.a[b];
  }
  for (std::size_t j = 0; j < at.gap.size(); ++j) {
    at.gap[j] += d * at.gap_rate[j] + 0.5 * d * d * at.gap_accel[j];
    at.gap_rate[j] += d * at.gap_accel[j];
  }
  for (std::size_t z = 0; z < at.law_state.size(); ++z) at.law_state[z] += d * at.law_rate[z];
  at.supplied += d * at.supply_power;
  at.dissipated += d * at.loss_power;
  if constexpr (Method::kEveryJointIsALaw) find_joint_forces(events_of_, at);
  return &at;
}

template <class Method, class S>
SwitchingEvent StepEvents<Method, S>::locate_event(double h, bool solved) {
  if (!events_of_.has_branches()) return {};
  return search_.first(RadauTable::of(method().n_), [&](double x, double* value) {
    solved ? method().evaluate_switching_functions(x, h, value) : method().extrapolate_switching_functions(x * h, value);
  });
}

template <class Method, class S>
bool StepEvents<Method, S>::rests(double h) {
  constexpr double kStill = 1e-12;  // [m], [rad]: a thousand times the rounding of positions within a few metres
  const BasicState<S>& now = method().end_state();
  return std::all_of(now.v.begin(), now.v.end(), [h](const typename S::Vec& v) { return v.cwiseAbs().maxCoeff() * h < kStill; });
}

template <class Method, class S>
bool StepEvents<Method, S>::motion_is_below_rounding(double h) {
  const BasicState<S>& now = method().end_state();
  const double rounding = std::numeric_limits<double>::epsilon() * largest_coordinate(now.q);
  for (std::size_t i = 0; i < now.v.size(); ++i)
    if (!((now.v[i].cwiseAbs() + 0.5 * h * now.a[i].cwiseAbs()).maxCoeff() * h < rounding)) return false;
  return true;
}

template <class Method, class S>
void StepEvents<Method, S>::cross_event(double distance, const SwitchingEvent& event) {
  const double before = method().end_time();
  before_crossing_ = method().end_state();
  has_crossed_ = true;
  motions_before_ = method().end_motions();
  const double beyond = std::max(std::min(StepControl::kCrossing, StepControl::kLate * method().tolerance_) * control_.usual, 4 * std::numeric_limits<double>::epsilon() * std::abs(before));
  search_.step_over(event, distance, beyond, [this](double d, double* value) {
    method().extrapolate_end_state(d);
    method().evaluate_switching_functions_at_end(value);
  });
  // A body cannot follow a target that jumps: the gap jumps instead.
  for (int j = 0; j < events_of_.n_joints(); ++j)
    if (const auto jump = target_jump(events_of_, j, std::max(before, before + distance - beyond), method().end_time())) method().shift_gap(j, -jump->position, -jump->rate);
  method().cross_borders();
  leave_sliding(events_of_, method().end_time(), method().end_motions(), method().sliding());
  method().balance_end();
  record();
  restart_search();
  const double now = method().end_time();
  if (const double late = now - (before + distance); late > 0) compensate_late_crossing(late, event.function);
  if (const auto jump = chattering_.crossed(events_of_, before, motions_before_, now, method().end_motions(), StepControl::kAtOnce * control_.usual)) {
    const double margin = events_of_.margin(*jump, now, method().end_motions());
    const RampSize size = ramp_size(events_of_, *jump, method().end_state(), StepControl::kAfterEvent * control_.usual, method().tolerance_);
    const bool held = enter_sliding(*jump, margin, size, method().sliding(), [this] { method().balance_end(); }, [&] { return margin_rate(*jump); });
    if (held && sliding_load_ < 0) sliding_load_ = jump->load;
  }
  update_switching();  // the compensation may have crossed a border: where surfaces slip at 1e-12 m/s, a load that jumps against them reverses the slip
  control_.event_crossed();
}

// Undone if it leads back before the event, as where a jump is crossed again and again.
template <class Method, class S>
void StepEvents<Method, S>::compensate_late_crossing(double late, int function) {
  const auto is_positive = [&] {
    method().evaluate_switching_functions_at_end(search_.end());
    return search_.end()[function] > 0;
  };
  const bool behind = is_positive();
  method().compensate_late_crossing(late);
  if (is_positive() != behind) method().undo_compensation();
}

// The rate of a jump's argument at the end, from its value a moment later.
template <class Method, class S>
double StepEvents<Method, S>::margin_rate(const SlidingMode& jump) {
  const double d = StepControl::kMoment * control_.usual, t = method().end_time();
  return (events_of_.margin(jump, t + d, method().motions_after(d)) - events_of_.margin(jump, t, method().end_motions())) / d;
}

template <class Method, class S>
void StepEvents<Method, S>::update_switching() {
  if (!events_of_.has_branches()) return;
  method().evaluate_switching_functions_at_end(search_.end());
  border_crossed_ = is_border_between(events_of_, search_.start(), search_.end());
  if (border_crossed_) before_borders_ = method().end_state();
  const bool crossed = method().cross_borders();
  if (!leave_sliding(events_of_, method().end_time(), method().end_motions(), method().sliding()) && !crossed) {
    search_.restart();
    return;
  }
  method().balance_end();
  control_.event_crossed();
  if (crossed) record();
  restart_search();
}

}  // namespace pintle
