// Step control of the implicit methods: predict, solve, estimate, accept or shrink; steps end at events. The same for
// free bodies and over a joint tree. theory/time sections 3.5 and 7.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <string>
#include <utility>
#include <vector>

#include "integrators/radau/event_location.h"
#include "integrators/thresholds.h"
#include "pintle/trajectory.h"
#include "system/system.h"

namespace pintle {

class StepControl {
 public:
  double next = 0, last = 0, usual = 0;  // steps: the next; the last; what it was before an event [s]
  double longest = 0;                    // [s]; 0: no limit
  bool have_history = false;             // the last step's curve goes on into the next one
  bool behind_event = false;             // the next step comes after an event

  // Events, in parts of the usual step.
  static constexpr double kCrossing = 1e-9;  // of the usual step: how far is gone to begin with to cross an event, at most
  static constexpr double kLate = 1e-4;      // the same, per tolerance of the steps: all passes cross an event equally late, and their difference does not show it. Break-away of a stuck slider at 1e-7: 2e-9 s late without it
  static constexpr double kAboveRounding = 2;     // times the rounding that has been met is taken off the error: that of one step is not that of the next
  static constexpr double kAtOnce = 1e-2;    // of the usual step: a jump that is crossed again within it may be held
  static constexpr double kMoment = 1e-6;    // of the usual step: how far is looked to see where accelerations lead

  void start(double h) {
    next = usual = h;
    have_history = false;
    behind_event = false;
    rounding_ = floor_h_ = floor_error_ = 0;
    at_floor_ = 0;
    same_ = stopped_short_ = 0;
    same_function_ = -1;
    steps_at_event_ = 0;
    event_ = {};
  }

  /// An event has been crossed: what was before it says nothing of what comes.
  void event_crossed() {
    have_history = false;
    behind_event = true;
  }
  /// A step of h has been made.
  void step_made(double h) {
    have_history = true;
    behind_event = false;
    last = h;
  }

  /// The last event that was crossed, or that no step could be made to.
  const SwitchingEvent& event() const { return event_; }
  /// The last event, if it came after `since`: whose, in which direction, when. Otherwise empty.
  template <class S>
  std::string last_event(const BasicSystem<S>& system, double since) const;

  /// One accepted step of `method`, not beyond t_end; its error estimate falls as h^order. False when no step could be made:
  /// `next` is then the last one tried. The method has t(), begin_at_end(), attempt(h), contraction(), locate_event(h, solved), sets_states(event), rests(h), motion_is_below_rounding(h),
  /// forces_stay_constant(distance), cross_event(distance, event), taylor_step(distance), rebalance_end(), error_estimate(h, error) and finish_step(h).
  template <class Method>
  bool advance(Method& method, double t_end, double tolerance, int order, Counters& counters);

 private:
  static constexpr int kMaxRetries = 80;          // trials of one step, at most
  static constexpr double kEventAtStart = 1e-5;   // of the usual step: an event this close to its start is crossed, if forces hold until then
  static constexpr int kSlow = 10;                // trials towards an event, after which they are taken for a sequence that comes nearer by a constant ratio: most come there in three
  static constexpr int kFewShort = 3;             // steps in a row that end before an event and do not come to it: places are rounded, and no shorter step comes nearer. 1 to 6 are as good; with 0 steps at the corners of a table are six times as many
  static constexpr int kMostCrossed = 24;         // events that are crossed at the start of one step, at most
  static constexpr std::uint64_t kStepsBetween = 10;  // of two events of one function, at most, that count as in a row. With 2 a ram that rests on its stop meets 4000 of them in 10 s, with 10 a few
  static constexpr int kMostSame = 8;                 // in a row, after which the next ones are met only if they matter
  static constexpr double kShrink = 0.5;          // of the step, after Newton's iteration failed; the most that its contraction shortens the next one
  static constexpr double kContraction = 0.2;     // of Newton's iteration, that steps are chosen for
  static constexpr double kSteady = 0.9;          // of the error of the trial before: a shorter step has not made it smaller
  static constexpr int kMostSteady = 3;           // such trials, after which the error counts as that of the accelerations that the step starts with
  static constexpr double kMostRounding = 1e-11;  // of the loads, a hundredth of the least tolerance: what may pass for rounding
  static constexpr double kVeryShort = 1e-6;      // of the run: steps that are shorter and do not grow may have met a floor
  static constexpr int kMostAtFloor = 20;         // such steps in a row, after which one is tried that is twice as long
  static constexpr double kShort = 0.9;           // of the way to an event that is only guessed at: so far the step goes
  static constexpr double kAfterEvent = 0.3;      // of the usual step: the first step after an event, where nothing is known of it
  // Of the way to an event: a step that ends so soon, for its error, is a usual one. Of the block in LinearContact half of it refuses 2400 steps and double of it
  // 630, where this refuses 1100; not a step changes in the worn pins and wheels of the collection. With all of the way, pins that stick take twice the steps.
  static constexpr double kOnTheWay = 0.01;
  static constexpr double kSafety = 0.9, kLeast = 0.15, kMost = 4, kMostAtFirst = 100;  // of the step for which the error would be the tolerance; the least ratio of two steps; the largest; the largest after the first step

  static constexpr double kSame = 0.95, kSameAbove = 1.1;  // ratio of two steps from which on the step is kept, and with it the factorised Jacobians; up to which it is

  static constexpr double kLeastError = 0.01;  // over the tolerance: a smaller one says nothing about its growth

  // Where the place of an event depends on how far the step goes beyond it, trials come nearer by a constant ratio: after a few the next one goes where
  // they lead.
  class Approach {
   public:
    double further(double h, double share, bool solved) {
      const double beyond = (1 - share) * h, ratio = beyond / beyond_before_;
      trials_ = solved ? trials_ + 1 : 0;
      beyond_before_ = beyond;
      return trials_ > kSlow && ratio > 0 && ratio < 1 ? std::min(beyond * ratio / (1 - ratio), 0.5 * share * h) : 0;
    }

   private:
    double beyond_before_ = 0;  // by how much the trial before went beyond its event
    int trials_ = 0;            // in a row that were solved, and did
  };

  double last_error_ = 0;  // over the tolerance
  int at_floor_ = 0;       // steps in a row
  double rounding_ = 0;    // of accelerations, over the tolerance: no step resolves it
  int stopped_short_ = 0;                 // steps in a row that ended before an event, without one that was crossed
  int same_ = 0, same_function_ = -1;     // events in a row of one function
  std::uint64_t steps_at_event_ = 0;      // made before the last of them
  double floor_h_ = 0, floor_error_ = 0;  // a step, and the error that shorter ones have not halved
  SwitchingEvent event_;

  // Events of one function with few steps between them: where nothing moves, the rounding of a speed is on either side of a kink.
  void count_same(const SwitchingEvent& event, const Counters& counters) {
    same_ = event.function == same_function_ && counters.steps - steps_at_event_ <= kStepsBetween ? same_ + 1 : 1;
    same_function_ = event.function;
    steps_at_event_ = counters.steps;
  }
  bool repeats(const SwitchingEvent& event, const Counters& counters) const {
    return event.function == same_function_ && same_ >= kMostSame && counters.steps - steps_at_event_ <= kStepsBetween;
  }
  // Where nothing moves, a kink that the step's error does not show need not be met. What a law's states remember does.
  template <class Method>
  static bool matters(Method& method, const SwitchingEvent& event, double h, double tolerance) {
    double error = 0;
    return method.sets_states(event) || !method.rests(h) || !method.error_estimate(h, error) || !(error <= tolerance);
  }

  bool is_at_start(double after) const { return after < 2 * kEventAtStart * usual; }
  // Whether an event so far after the start of a step is crossed there. A touch may be ten thousand times as short as the flight before it: its end is only if
  // forces stay what they are until then.
  template <class Method>
  bool is_crossed_at_start(Method& method, double after) const {
    return is_at_start(after) && method.forces_stay_constant(after);
  }

  // Whether half of a step has more than half of its error.
  bool is_floor(double h, double error) {
    const bool is = h < 0.5 * floor_h_ && error > 0.5 * floor_error_;
    if (h >= floor_h_ || error < 0.5 * floor_error_) {
      floor_h_ = h;
      floor_error_ = error;
    }
    return is;
  }

  // The step that Newton's iteration will like, over one in which its errors shrank by `contraction`; 0: not known.
  static double of_contraction(double contraction) { return contraction > 0 ? std::max(kShrink, std::sqrt(kContraction / contraction)) : kMost; }

  // An error of rounding just below the tolerance keeps steps as short as they happen to be.
  void leave_floor(double h, double t_end) {
    at_floor_ = next < kSameAbove * h && h < kVeryShort * std::abs(t_end) ? at_floor_ + 1 : 0;
    if (at_floor_ < kMostAtFloor) return;
    next *= 2;
    at_floor_ = 0;
  }

  // An error that grows goes on growing: K. Gustafsson's predictive controller.
  double foresee_growth(double factor, double h, double error, int order) const {
    if (!have_history || !(last > 0) || h < last || !(last_error_ > 0) || !(error > 0)) return factor;
    return std::clamp(factor * (h / last) * std::pow(last_error_ / error, 1.0 / order), kLeast, factor);
  }

  // The far end of a step may lie beyond other events than one that is next to its start, and its curve need not be what a body at rest does: Taylor's series is
  // better there. False where it does not lead to one within that time.
  template <class Method>
  static bool locate_on_taylor_series(Method& method, double within, double h, SwitchingEvent& event) {
    const SwitchingEvent closer = method.locate_event(within, false);
    if (!(closer.after < 1)) return false;
    event = closer;
    event.before *= within / h;
    event.after *= within / h;
    return true;
  }

  // The first event within a step of h. A step that was not solved twice may have a jump inside.
  template <class Method>
  SwitchingEvent first_event(Method& method, double h, bool solved, double tolerance, const Counters& counters) const {
    SwitchingEvent event = method.locate_event(h, solved);
    if (event.before * h < kEventAtStart * usual) locate_on_taylor_series(method, 2 * kEventAtStart * usual, h, event);
    const bool left_alone = solved && event.after < 1 && repeats(event, counters) && !matters(method, event, h, tolerance);
    return left_alone ? SwitchingEvent{} : event;
  }

  template <class Method>
  void cross_at_start(Method& method, double distance, const SwitchingEvent& event, Counters& counters) {
    ++counters.events;
    count_same(event, counters);
    method.cross_event(distance, event);
    stopped_short_ = 0;
    method.begin_at_end();
  }

  // Steps may end before an event over and over where places are rounded. A step of its own leads up to it then, by Taylor's series; false where that has no event.
  template <class Method>
  bool make_taylor_step(Method& method, double h, SwitchingEvent event) const {
    const double ahead = event.before * h;
    if (is_at_start(ahead) || stopped_short_ < kFewShort || !method.motion_is_below_rounding(ahead) || !method.forces_stay_constant(ahead)) return false;
    if (!locate_on_taylor_series(method, 2 * ahead, h, event)) return false;
    method.taylor_step(event.before * h);
    return true;
  }

  void accept(double h, double factor, bool up_to_event) {
    next = factor > kSame && factor < kSameAbove ? h : h * factor;
    stopped_short_ = up_to_event ? stopped_short_ + 1 : 0;
    if (up_to_event) next = std::max(next, kAfterEvent * usual);  // a better guess than this stump
    else usual = next;
  }
};

template <class Method>
bool StepControl::advance(Method& method, double t_end, double tolerance, int order, Counters& counters) {
  method.begin_at_end();
  double h = longest > 0 ? std::min(next, longest) : next;
  bool up_to_event = false, refused = false;  // by Newton's iteration
  double error_before = 0;                   // of the trial before, over the tolerance
  int steady = 0;                            // trials in a row that were shorter, and no better
  bool renewed = false;                      // the start, for this trial
  int crossed = 0;                           // events at its start
  SwitchingEvent ahead;                      // the last that was located
  Approach approach;                         // to an event
  for (int retry = 0; retry < kMaxRetries; ++retry) {
    const double left = t_end - method.t(), last_bits = kLastBits * std::max(std::abs(method.t()), std::abs(t_end));
    if (crossed > 0 && left <= last_bits) return true;  // the last event was at the end
    if (h > left || (!up_to_event && left - h < 1e-3 * h)) h = left;
    else if (!up_to_event && left < 1.7 * h) h = 0.5 * left;
    if (h <= kLastBits * std::abs(method.t())) break;  // however far away the end is
    const bool solved = method.attempt(h);
    if (!solved) {
      ++counters.newton_failures;
      refused = true;
      have_history = have_history && retry == 0;
    }
    if (const double seen = solved ? method.share_of_step(h, t_end) : 1; seen < 1) {
      ++counters.rejected;
      h *= std::max(seen, kLeast);  // what Newton's iteration found may lie anywhere
      up_to_event = false;
      continue;
    }
    // Functions that flicker about zero in the last bits are left alone after a while.
    const SwitchingEvent event = (solved || retry > 0) && crossed < kMostCrossed ? first_event(method, h, solved, tolerance, counters) : SwitchingEvent{};
    if (event.after < 1) {
      ahead = event;
      ahead.t = method.t() + event.before * h;
    }
    if (event.before < 1 && make_taylor_step(method, h, event)) return ++counters.steps, true;
    if (event.before < 1 && is_crossed_at_start(method, event.before * h)) {
      event_ = ahead;
      cross_at_start(method, event.before * h, event, counters);
      ++crossed;
      retry = -1;  // it has moved on
      h = std::max(h, kAfterEvent * usual);
      continue;
    }
    if (event.after < 1) {
      up_to_event = true;
      const bool at_end = solved && left - event.before * h <= last_bits;  // then there is nothing behind it
      // So that the last stage is not on it.
      h = at_end ? std::min(event.before * h, left) - last_bits / 8 : h * (event.before * (solved ? 1 - 0.1 * kEventAtStart : kShort)) - approach.further(h, event.before, solved);
      if (solved) ++counters.rejected;
      continue;
    }
    double error = 0;
    if (!solved || !method.error_estimate(h, error)) {
      if (solved) ++counters.newton_failures;
      // A force that jumps at a speed that rounding alone has left: the bodies are on one side or on the other in each iteration, whatever the step.
      if (!solved && h <= kShortestRefused * std::abs(t_end) && method.motion_is_below_rounding(h)) {
        method.taylor_step(h);
        next = std::max(h, kAfterEvent * usual);
        return ++counters.steps, true;
      }
      h *= kShrink;
      continue;
    }
    error /= tolerance;
    if (renewed && error < kSteady * error_before && error_before * tolerance < kMostRounding) rounding_ = std::max(rounding_, error_before);
    renewed = false;
    const double measured = error;
    if (measured * tolerance < kMostRounding && is_floor(h, measured)) rounding_ = std::max(rounding_, measured);
    error = std::max(error - kAboveRounding * rounding_, 0.0);
    double factor = std::clamp(kSafety * std::pow(std::max(error, 1e-14), -1.0 / order), kLeast, counters.steps == 0 ? kMostAtFirst : kMost);
    const bool jump = error > 1 && h <= kShortestRefused * std::abs(t_end);
    if (jump) factor = kMost;
    if (error > 1 && !jump) {
      ++counters.rejected;
      steady = measured > kSteady * error_before ? steady + 1 : 0;
      error_before = measured;
      renewed = steady == kMostSteady;
      if (renewed) {
        method.rebalance_end();
        method.begin_at_end();
      } else {
        h *= std::min(factor, 0.7);
      }
      continue;
    }
    factor = foresee_growth(factor, h, error, order);
    last_error_ = std::max(error, kLeastError);
    if (refused) factor = std::min(factor, 1.0);
    if (counters.steps > 0 && error > 0) factor = std::min(factor, of_contraction(method.contraction()));  // of a step without an error beyond rounding it says nothing
    if (up_to_event && h < kOnTheWay * (ahead.t - method.t())) up_to_event = false;
    method.finish_step(h);
    ++counters.steps;
    accept(h, factor, up_to_event);
    leave_floor(h, t_end);
    return true;
  }
  next = h;
  if (ahead.function >= 0) event_ = ahead;
  return false;
}

/// When and how small the last step was, the event near it if there is one, and the joints with the largest residuals: (residual [m/s^2],
/// joint) each.
template <class S>
std::string no_step_message(const BasicSystem<S>& system, double t, double h, std::vector<std::pair<double, int>> residuals, const std::string& event);

}  // namespace pintle
