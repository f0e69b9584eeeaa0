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
#include "system/state.h"
#include "system/system.h"

namespace pintle {

class StepControl {
 public:
  double next = 0, last = 0, usual = 0;  // step sizes [s]: the next; the last; the usual one, before an event shortened it
  double longest = 0;                    // [s]; 0: no limit
  double largest_error = 0;              // of the steps taken since the start, in units of the tolerance
  bool have_history = false;             // the last step's curve continues into the next one
  bool behind_event = false;             // the next step is the first after an event

  // Events.
  static constexpr double kCrossing = 1e-9;  // upper limit, as a fraction of the usual step, on how far the first attempt at crossing an event goes beyond it
  static constexpr double kLate = 1e-4;      // the same, per unit of the steps' tolerance: all passes cross an event equally late, so their difference does not show it. Without it the break-away of a stuck slider at 1e-7 is 2e-9 s late
  static constexpr double kAboveRounding = 2;     // this multiple of the rounding error met so far is subtracted from the error: rounding differs from step to step
  static constexpr double kAtOnce = 1e-2;    // fraction of the usual step: a jump that is crossed again within it may be held
  static constexpr double kAfterEvent = 0.3;      // fraction of the usual step: lower limit on the first step after an event, where no error is known
  static constexpr double kMoment = 1e-6;    // fraction of the usual step over which motions are extrapolated to see where accelerations lead

  void start(double h) {
    next = usual = h;
    largest_error = 0;
    have_history = false;
    behind_event = false;
    rounding_ = floor_h_ = floor_error_ = 0;
    at_floor_ = 0;
    same_ = stopped_short_ = unreached_ = 0;
    short_step_ = 0;
    same_function_ = -1;
    steps_at_event_ = 0;
    event_ = {};
  }

  /// An event has been crossed: the motion before it is no guide to the motion after it.
  void event_crossed() {
    have_history = false;
    behind_event = true;
  }
  /// A step of h has been taken.
  void step_made(double h) {
    have_history = true;
    behind_event = false;
    last = h;
  }

  /// The last event that was crossed, or at which no step succeeded.
  const SwitchingEvent& event() const { return event_; }
  /// The last event, if it came after `since`: its function, direction and time. Otherwise empty.
  template <class S>
  std::string last_event(const BasicSystem<S>& system, double since) const;

  /// One accepted step of `method`, not beyond t_end; its error estimate decreases as h^order. False when no step succeeded: `next` is then the last one tried. The method has t(),
  /// begin_at_end(), attempt(h), contraction(), locate_event(h, solved), sets_states(event), rests(h), motion_is_below_rounding(h), forces_stay_constant(distance), cross_event(distance,
  /// event), taylor_step(distance), rebalance_end(), error_estimate(h, error) and finish_step(h).
  template <class Method>
  bool advance(Method& method, double t_end, double tolerance, int order, Counters& counters);

 private:
  static constexpr int kMaxRetries = 80;          // attempts at one step, at most
  static constexpr double kEventAtStart = 1e-5;   // fraction of the usual step: an event this close to a step's start is crossed there, if forces stay constant until then
  static constexpr int kSlow = 10;                // attempts at reaching an event, after which they are taken for a sequence that converges by a constant ratio: most arrive in three
  static constexpr int kFewShort = 3;             // steps in a row that end before an event without reaching it, before a Taylor step is tried: positions are rounded, and a shorter step gets no closer. 1 to 6 are equally good; 0 takes six times the steps at the corners of a table
  static constexpr double kSameDistance = 0.01;    // relative difference of two steps up to an event for which the first has not got nearer to it
  static constexpr int kMostCrossed = 24;         // events crossed at the start of one step, at most
  static constexpr std::uint64_t kStepsBetween = 10;  // steps between two events of one function, at most, for them to count as consecutive. With 2 a ram that rests on its stop meets 4000 of them in 10 s, with 10 a few
  static constexpr int kMostSame = 8;                 // consecutive events, after which further ones are crossed only if they matter
  static constexpr double kShrink = 0.5;          // ratio of steps after Newton's iteration failed; also the most by which its contraction rate shortens the next step
  static constexpr double kContraction = 0.2;     // contraction rate of Newton's iteration for which steps are chosen
  static constexpr double kSteady = 0.9;          // fraction of the error of the previous attempt: above it, a shorter step has not reduced the error
  static constexpr int kMostSteady = 3;           // shorter steps in a row that have not reduced the error, after which it is attributed to the accelerations at the start of the step
  static constexpr double kMostRounding = 1e-11;  // fraction of the loads, a hundredth of the smallest tolerance: the largest error that may be rounding
  static constexpr double kPerhapsRounding = 1e-7;  // fraction of the loads: a smaller error that does not depend on the step says nothing about its length, once the accelerations are renewed; a larger one may be a jump. A bar on a pin (8 rad/s, 30 s) takes 59,000 steps, with half of it 69,000, with double the same; without a limit a four-bar with friction takes three times the steps
  static constexpr double kVeryShort = 1e-6;      // fraction of the run: shorter steps that do not grow may have reached a floor of rounding
  static constexpr int kMostAtFloor = 20;         // very short steps in a row, after which one twice as long is tried
  static constexpr double kShort = 0.9;           // fraction of the distance to an event that is only estimated: the next attempt covers this much
  // Fraction of the distance to an event: a step limited by its error to less than this is a usual one. For the block in LinearContact half of it rejects 2400
  // steps, twice it 630, this 1100; not a step changes in the worn pins and wheels of the collection. With 1, pins that stick take twice the steps. Also the
  // distance, as a fraction of the usual step, from which an event is crossed that no step reaches.
  static constexpr double kOnTheWay = 0.01;
  static constexpr double kSafety = 0.9, kLeast = 0.15, kMost = 4, kMostAtFirst = 100;  // factor on the step for which the error would equal the tolerance; smallest ratio of two steps; largest ratio; largest ratio after the first step

  static constexpr double kSame = 0.95, kSameAbove = 1.1;  // smallest step ratio for which the step is kept, and with it the factorised Jacobians; largest ratio for which it is kept

  static constexpr double kLeastError = 0.01;  // relative to the tolerance: a smaller error is no guide to its growth

  // Consecutive attempts that were shorter, but no better.
  struct Steady {
    double longest = 0, error = 0;  // the first of them [s]; that of the last attempt, relative to the tolerance
    int n = 0;
    // Whether there are now enough of them.
    bool add(double h, double measured) {
      n = measured > kSteady * error ? n + 1 : 0;
      if (n == 1) longest = h;
      error = measured;
      return n == kMostSteady;
    }
  };

  // Where the located position of an event depends on how far the step overshoots it, attempts converge by a constant ratio: after a few of them the
  // next one goes to their limit. If they do not converge, the step is too long for its curve to be the motion, and is halved.
  class Approach {
   public:
    double further(double h, double share, bool solved) {
      const double beyond = (1 - share) * h, ratio = beyond / beyond_before_;
      trials_ = solved ? trials_ + 1 : 0;
      beyond_before_ = beyond;
      if (trials_ <= kSlow || !(ratio > 0)) return 0;
      return ratio < 1 ? std::min(beyond * ratio / (1 - ratio), 0.5 * share * h) : 0.5 * share * h;
    }

   private:
    double beyond_before_ = 0;  // by how much the previous attempt went beyond its event
    int trials_ = 0;            // consecutive ones that were solved and went beyond it
  };

  double last_error_ = 0;  // relative to the tolerance
  int at_floor_ = 0;       // steps in a row
  double rounding_ = 0;    // rounding error of accelerations, relative to the tolerance: no step resolves it
  int stopped_short_ = 0;                 // steps in a row that ended before an event, since the last one that was crossed
  double short_step_ = 0;                 // the last step, if it led up to an event [s]
  int unreached_ = 0;                     // such steps in a row that were equally long
  int same_ = 0, same_function_ = -1;     // consecutive events of one function
  std::uint64_t steps_at_event_ = 0;      // steps taken before the last of them
  double floor_h_ = 0, floor_error_ = 0;  // a step, and its error, which shorter steps have not halved
  SwitchingEvent event_;

  // Events of one function with few steps between them: where nothing moves, rounding puts a speed on either side of a kink.
  void count_same(const SwitchingEvent& event, const Counters& counters) {
    same_ = event.function == same_function_ && counters.steps - steps_at_event_ <= kStepsBetween ? same_ + 1 : 1;
    same_function_ = event.function;
    steps_at_event_ = counters.steps;
  }
  bool repeats(const SwitchingEvent& event, const Counters& counters) const {
    return event.function == same_function_ && same_ >= kMostSame && counters.steps - steps_at_event_ <= kStepsBetween;
  }
  // Where nothing moves, a kink that does not show in the step's error may be passed over. One at which a law sets its states may not.
  template <class Method>
  static bool matters(Method& method, const SwitchingEvent& event, double h, double tolerance) {
    double error = 0;
    return method.sets_states(event) || !method.rests(h) || !method.error_estimate(h, error) || !(error <= tolerance);
  }

  bool is_at_start(double after) const { return after < 2 * kEventAtStart * usual; }
  // Whether an event this long after the start of a step is crossed there. A contact may be ten thousand times as short as the flight before it: its end is
  // crossed there only if forces stay constant until then. An event that steps of this length have got no nearer to is crossed from farther away: in the steep
  // ramp of a held jump a speed may be the last number before the ramp's end, and a body at rest moves by less than the rounding of its position.
  template <class Method>
  bool is_crossed_at_start(Method& method, double after) const {
    const bool out_of_reach = unreached_ >= kFewShort && is_same_distance(after, short_step_);
    return out_of_reach ? after < kOnTheWay * usual : is_at_start(after) && method.forces_stay_constant(after);
  }
  static bool is_same_distance(double a, double b) { return std::abs(a - b) < kSameDistance * a; }

  // Whether half of a step has more than half of its error.
  bool is_floor(double h, double error) {
    const bool is = h < 0.5 * floor_h_ && error > 0.5 * floor_error_;
    if (h >= floor_h_ || error < 0.5 * floor_error_) {
      floor_h_ = h;
      floor_error_ = error;
    }
    return is;
  }

  // The step ratio that suits Newton's iteration, after a step with this contraction rate; 0: rate not known.
  static double of_contraction(double contraction) { return contraction > 0 ? std::max(kShrink, std::sqrt(kContraction / contraction)) : kMost; }

  // A rounding error just below the tolerance would keep steps at whatever short length they have.
  void leave_floor(double h, double t_end) {
    at_floor_ = next < kSameAbove * h && h < kVeryShort * std::abs(t_end) ? at_floor_ + 1 : 0;
    if (at_floor_ < kMostAtFloor) return;
    next *= 2;
    at_floor_ = 0;
  }

  // An error that grows is expected to continue to grow: K. Gustafsson's predictive controller.
  double foresee_growth(double factor, double h, double error, int order) const {
    if (!have_history || !(last > 0) || h < last || !(last_error_ > 0) || !(error > 0)) return factor;
    return std::clamp(factor * (h / last) * std::pow(last_error_ / error, 1.0 / order), kLeast, factor);
  }

  // For an event close to the start of a step Taylor's series is better than the step's curve: the far end of the step may lie beyond other events, and its
  // curve need not be the motion of a body at rest. False where the series reaches no event within that time.
  template <class Method>
  static bool locate_event_on_taylor_series(Method& method, double within, double h, SwitchingEvent& event) {
    const SwitchingEvent closer = method.locate_event(within, false);
    if (!(closer.after < 1)) return false;
    event = closer;
    event.before *= within / h;
    event.after *= within / h;
    return true;
  }

  // The first event within a step of h. A step that has failed twice may contain a jump. The curve of a step across a jump leads to the jump too early, by the same part of the
  // step however often it is tried: after a step that has ended before an event without reaching it, the Taylor series is followed where it leads there later.
  template <class Method>
  SwitchingEvent first_event(Method& method, double h, bool solved, double tolerance, const Counters& counters) const {
    SwitchingEvent event = method.locate_event(h, solved);
    if (event.before * h < kEventAtStart * usual) locate_event_on_taylor_series(method, 2 * kEventAtStart * usual, h, event);
    SwitchingEvent later;
    if (solved && event.after < 1 && stopped_short_ > 0 && locate_event_on_taylor_series(method, h, h, later) && later.function == event.function && kShort * later.before > event.before)
      event = later;
    const bool left_alone = solved && event.after < 1 && repeats(event, counters) && !matters(method, event, h, tolerance);
    return left_alone ? SwitchingEvent{} : event;
  }

  template <class Method>
  void cross_at_start(Method& method, double distance, const SwitchingEvent& event, Counters& counters) {
    ++counters.events;
    count_same(event, counters);
    method.cross_event(distance, event);
    stopped_short_ = unreached_ = 0;
    short_step_ = 0;
    method.begin_at_end();
  }

  // Rounded positions may make steps end before an event over and over. Then a Taylor step of its own leads up to it; false if the series has no event.
  template <class Method>
  bool make_taylor_step(Method& method, double h, SwitchingEvent event) const {
    const double ahead = event.before * h;
    if (is_at_start(ahead) || stopped_short_ < kFewShort || !method.motion_is_below_rounding(ahead) || !method.forces_stay_constant(ahead)) return false;
    if (!locate_event_on_taylor_series(method, 2 * ahead, h, event)) return false;
    method.taylor_step(event.before * h);
    return true;
  }

  void accept(double h, double factor, bool up_to_event) {
    next = factor > kSame && factor < kSameAbove ? h : h * factor;
    stopped_short_ = up_to_event ? stopped_short_ + 1 : 0;
    unreached_ = up_to_event && is_same_distance(h, short_step_) ? unreached_ + 1 : 0;
    short_step_ = up_to_event ? h : 0;
    if (up_to_event) next = std::max(next, kAfterEvent * usual);  // a better guess than this shortened step
    else usual = next;
  }
};

template <class Method>
bool StepControl::advance(Method& method, double t_end, double tolerance, int order, Counters& counters) {
  method.begin_at_end();
  double h = longest > 0 ? std::min(next, longest) : next;
  bool up_to_event = false, refused = false;  // refused by Newton's iteration
  Steady steady;
  bool renewed = false;                      // the start has been, for this attempt
  int crossed = 0;                           // events crossed at its start
  SwitchingEvent ahead;                      // the last event located
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
      h *= std::max(seen, kLeast);  // the solution of Newton's iteration may lie anywhere
      up_to_event = false;
      continue;
    }
    // Functions that change sign again and again in the last bits are ignored after a while.
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
      retry = -1;  // the start has moved on
      h = std::max(h, kAfterEvent * usual);
      continue;
    }
    if (event.after < 1) {
      up_to_event = true;
      const bool at_end = solved && left - event.before * h <= last_bits;  // then nothing follows it
      // Keeps the last stage off the event.
      h = at_end ? std::min(event.before * h, left) - last_bits / 8 : h * (event.before * (solved ? 1 - 0.1 * kEventAtStart : kShort)) - approach.further(h, event.before, solved);
      if (solved) ++counters.rejected;
      continue;
    }
    double error = 0;
    if (!solved || !method.error_estimate(h, error)) {
      if (solved) ++counters.newton_failures;
      // A force that jumps at a speed that is pure rounding error: each iteration puts the bodies on one side or the other, whatever the step.
      if (!solved && h <= kShortestRefused * std::abs(t_end) && method.motion_is_below_rounding(h)) {
        method.taylor_step(h);
        next = std::max(h, kAfterEvent * usual);
        return ++counters.steps, true;
      }
      h *= kShrink;
      continue;
    }
    error /= tolerance;
    if (renewed && error < kSteady * steady.error && steady.error * tolerance < kMostRounding) rounding_ = std::max(rounding_, steady.error);
    renewed = false;
    const double measured = error;
    if (measured * tolerance < kMostRounding && is_floor(h, measured)) rounding_ = std::max(rounding_, measured);
    error = std::max(error - kAboveRounding * rounding_, 0.0);
    double factor = std::clamp(kSafety * std::pow(std::max(error, 1e-14), -1.0 / order), kLeast, counters.steps == 0 ? kMostAtFirst : kMost);
    const bool jump = error > 1 && h <= kShortestRefused * std::abs(t_end);
    if (jump) factor = kMost;
    if (error > 1 && !jump) {
      ++counters.rejected;
      renewed = steady.add(h, measured);
      if (renewed) {
        method.rebalance_end();
        method.begin_at_end();
        if (measured * tolerance < kPerhapsRounding) h = steady.longest;  // it was not too long
      } else {
        h *= std::min(factor, 0.7);
      }
      continue;
    }
    largest_error = std::max(largest_error, measured);
    factor = foresee_growth(factor, h, error, order);
    last_error_ = std::max(error, kLeastError);
    if (refused) factor = std::min(factor, 1.0);
    if (counters.steps > 0 && error > 0) factor = std::min(factor, of_contraction(method.contraction()));  // without an error above rounding the contraction is no guide
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

/// What is not finite at `start`, where the last step began; otherwise its time and size, the event near it if there is one, and the joints with the largest
/// residuals: (residual [m/s^2], joint) each.
template <class S>
std::string no_step_message(const BasicSystem<S>& system, const BasicState<S>& start, double h, std::vector<std::pair<double, int>> residuals, const std::string& event);

}  // namespace pintle
