#include "run/integration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "integrators/bend_watch.h"
#include "integrators/methods.h"
#include "run/pass_constants.h"
#include "system/target_jumps.h"

namespace pintle {

namespace {

constexpr std::uint64_t kMaxSteps = 20'000'000;  // upper limit for one integration
constexpr std::uint64_t kManyEvents = 1000;       // a motion that stands still after more events than this switches its forces to and fro
constexpr const char* kSwitchesOften = ". A force that switches so often jumps where the motion stays, as sign(...) of a rate does where a body comes to rest: write a steep slope instead, "
                                       "as tanh(rate/(1 mm/s)), or friction";

// Detects a motion that needs ever shorter steps because it diverges.
class Standstill {
 public:
  explicit Standstill(double duration) : least_(kLeastShare * duration) {}
  // Call once per step.
  bool reached(double t) {
    if (++steps_ < kSteps) return false;
    const bool still = t - end_ < least_;
    steps_ = 0;
    since_ = end_;
    end_ = t;
    return still;
  }
  // When the last kSteps steps began [s].
  double since() const { return since_; }

 private:
  static constexpr int kSteps = 20000;         // steps between two checks of how far the time has advanced
  static constexpr double kLeastShare = 1e-6;  // least advance of kSteps steps, as a fraction of the duration
  double least_, since_ = 0, end_ = 0;
  int steps_ = 0;
};

// A step may span much of a period of the motion, and the dense output of radau has correspondingly many samples of the forces; other methods on free bodies resolve
// the joints' vibrations. Forces that balance the instantaneous loads, as those of ideal joints do, change as fast as the loads; the error of the motion need not show this.
LoadSampling load_sampling(const MethodChoice& choice, double tolerance, double output_step) {
  constexpr double kFinest = 1e-8;  // resolution: peaks lack finer details. With 1e-7, the RMS of a load with a pulse is right to 5e-10, and the run takes a fifth less time
  constexpr double kOfTolerance = 0.01;  // accuracy of means and bearing loads, as a fraction of the tolerance. With half or twice as much no run changes visibly; with 1, mean forces of goods_lift at 1e-3 are wrong by 2e-4, and with 1e-6 n_four_bar_10 takes 1.7 times as long
  const double accuracy = kOfTolerance * tolerance;
  if (choice.equations != Equations::kNewtonian) return {CurveGrid::kMost, accuracy, std::max(tolerance, kFinest), (CurveGrid::kMost - 1) * output_step};  // as many samples as rows
  return {choice.method == "radau" ? CurveGrid::kMost : 3, accuracy};
}

// Times at which steps must end so as not to pass over a pulse, a kink or a jump of a load or drive.
template <class S>
std::vector<double> stops_at_bends(const BasicSystem<S>& system, double from, double to) {
  std::vector<double> stops = kinks_in_time(system, from, to);
  for (const Bends& bends : bends_in_time(system, from, to)) stops.insert(stops.end(), bends.places.begin(), bends.places.end());
  std::sort(stops.begin(), stops.end());
  return stops;
}

// The longest step [s] of methods that do not watch what they pass, if a load depends on positions: its pulses may be no longer than this.
template <class S>
double longest_step(const BasicSystem<S>& system, double duration, double wanted) {
  constexpr double kLooks = 500;  // steps per run, at least
  const auto reads_places = [](const BasicLoadData<S>& load) { return std::any_of(load.signals.begin(), load.signals.end(), [](const BasicSignal<S>& signal) { return !signal.is_time; }); };
  if (std::none_of(system.loads.begin(), system.loads.end(), reads_places)) return wanted;
  return wanted > 0 ? std::min(wanted, duration / kLooks) : duration / kLooks;
}

// Whether the energy ends the integration.
template <class S>
bool alarmed(typename BasicEnergyWatch<S>::Alarm alarm, const BasicEnergyWatch<S>& energy, BasicIntegration<S>& out) {
  using Alarm = typename BasicEnergyWatch<S>::Alarm;
  if (alarm == Alarm::kNone) return false;
  out.ended = alarm == Alarm::kRunaway ? Ended::kRunaway : Ended::kEnergyOpen;
  out.message = energy.message();
  return true;
}

}  // namespace

template <class S>
BasicIntegration<S> integrate(const BasicSystem<S>& system, const BasicState<S>& start, const BasicIntegrationPlan<S>& plan, BasicForceRecorder<S>& recorder) {
  const std::unique_ptr<BasicStepper<S>> method = make_stepper(system, plan.choice, plan.tolerance);
  BasicStepper<S>& stepper = *method;
  BasicIntegration<S> out;
  stepper.set_max_step(stepper.watches_bends() ? plan.max_step : longest_step(system, plan.duration, plan.max_step));
  if (plan.scale) stepper.set_load_scale(*plan.scale);
  stepper.start(start, plan.first_step);
  recorder.start(stepper.state(), load_sampling(plan.choice, plan.tolerance, plan.output_step));
  if (plan.energy) plan.energy->start(stepper.state());
  std::size_t row = 1;
  const double end = plan.duration, almost = end * kAlmostAll;
  const auto jumps_at_end = has_constraints(plan.choice.equations) ? first_target_jump(system, almost, end) : std::nullopt;
  const double last = jumps_at_end ? jumps_at_end->t : end;  // a motor's table that ends with the run has no speed from there on
  Standstill standstill(end);
  const std::vector<double> stops = stepper.watches_bends() ? std::vector<double>{} : stops_at_bends(system, stepper.state().t, end);
  std::size_t stop = 0;
  while (stepper.state().t < almost) {
    while (stop < stops.size() && stops[stop] <= stepper.state().t + (end - almost)) ++stop;
    if (!stepper.step(stop < stops.size() && stops[stop] < last ? stops[stop] : last)) {
      out.ended = Ended::kFailed;
      out.message = stepper.failure();
      break;
    }
    const BasicState<S>& now = stepper.state();
    if (const auto jump = has_constraints(plan.choice.equations) ? first_target_jump(system, stepper.previous().t, now.t) : std::nullopt) {
      out.ended = Ended::kFailed;
      out.message = infinite_force_message(*jump, system.joints[static_cast<std::size_t>(jump->joint)]);
      break;
    }
    recorder.see_step(stepper);
    if (const double h = now.t - stepper.previous().t; stepper.nodes() != nullptr && h > 0) {
      if (plan.ringing) plan.ringing->see_step(*stepper.nodes(), h);
      if (plan.instability) plan.instability->see_step(now, h, stepper.nodes()->table->n);
    }
    for (double t = static_cast<double>(row) * plan.output_step; t <= now.t && t < almost;
         t = static_cast<double>(++row) * plan.output_step)
      recorder.add(stepper.interpolate(t));
    if (plan.energy && alarmed(plan.energy->see_step(now, now.t - stepper.previous().t), *plan.energy, out)) break;
    if (standstill.reached(now.t)) {
      out.ended = Ended::kFailed;
      out.message = fmt::format("the motion diverges, or the tolerance is below the rounding error of the forces: steps of {:.3g} s at t = {:.9g} s", now.t - stepper.previous().t, now.t);
      if (const std::string event = stepper.last_event(standstill.since()); !event.empty())
        out.message += fmt::format(", after {} events; the last: {}", stepper.counters().events, event);
      if (stepper.counters().events > kManyEvents) out.message += kSwitchesOften;
      break;
    }
    if (stepper.counters().steps >= kMaxSteps) {
      out.ended = Ended::kFailed;
      out.message = fmt::format("more than {} steps before t = {:.9g} s: this method needs steps of {:.3g} s here; choose {}a larger tolerance",
                                kMaxSteps, now.t, now.t - stepper.previous().t, plan.choice.method == "radau" ? "" : "radau, or ");
      break;
    }
    if (plan.keep_going && !plan.keep_going(now.t)) {
      out.ended = Ended::kStopped;
      break;
    }
  }
  if (plan.energy && out.ended == Ended::kAtEnd) alarmed(plan.energy->see_end(stepper.state()), *plan.energy, out);
  recorder.finish(stepper);
  out.t = stepper.state().t;
  out.counters = stepper.counters();
  out.scale = stepper.load_scale();
  out.crossings = stepper.crossings();
  out.remarks = stepper.remarks();
  out.sliding_load = stepper.sliding_load();
  out.largest_step_error = stepper.largest_step_error();
  out.unbounded_reactions = stepper.unbounded_reactions();
  return out;
}

template Integration integrate(const System& system, const State& start, const IntegrationPlan& plan, ForceRecorder& recorder);
PINTLE_IN_SPACE(template BasicIntegration<Spatial> integrate(const BasicSystem<Spatial>& system, const BasicState<Spatial>& start, const BasicIntegrationPlan<Spatial>& plan, BasicForceRecorder<Spatial>& recorder);)

}  // namespace pintle
