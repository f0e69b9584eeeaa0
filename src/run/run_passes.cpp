#include "run/run_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "integrators/thresholds.h"
#include "run/energy_watch.h"
#include "run/errors/error_growth.h"
#include "run/errors/promises.h"
#include "run/errors/stated_error.h"
#include "run/integration.h"
#include "run/limits/torn_joints.h"
#include "run/pass_constants.h"
#include "run/pass_decisions.h"
#include "run/record/joint_events.h"
#include "run/recording.h"
#include "system/size_about_origin.h"

namespace pintle {
namespace {

using namespace pass_decisions;

template <class S>
class Passes {
 public:
  Passes(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const BasicPassContext<S>& context, Trajectory& out)
      : system_(system), start_(start), settings_(settings), context_(context), out_(out), fine_ringing_(system, start, context.effective_mass), instability_(system, settings.duration) {}

  std::unique_ptr<BasicForceRecorder<S>> go() {
    out_.tolerance = settings_.tolerance;
    choice_ = resolve_method(settings_);
    out_.method = choice_.method;
    out_.of_motion = choice_.tolerance_of == ToleranceOf::kMotion;
    make_passes();
    return std::move(fine_);
  }

 private:
  BasicIntegrationPlan<S> plan(double tolerance) {
    BasicIntegrationPlan<S> p;
    p.duration = settings_.duration;
    p.output_step = output_step_of(settings_, system_.joints.size());
    p.max_step = longest_ > 0 && !(settings_.max_step > 0 && settings_.max_step < longest_) ? longest_ : settings_.max_step;
    p.tolerance = tolerance;
    p.choice = choice_;
    p.first_step = kFirstStep * p.duration;
    if (!last_.scale.body.empty()) p.scale = &last_.scale;
    p.keep_going = [this](double t) { return report(t); };
    return p;
  }

  bool report(double t) {
    const double now = context_.clock.seconds();
    if (!context_.observer || now - reported_ < 0.1) return true;
    reported_ = now;
    return context_.observer({t, settings_.duration, static_cast<int>(out_.counters.passes) + 1, now});
  }

  // Returns false if the pass did not reach the end. The earlier passes then stand, unless it was the first.
  bool run_pass(double tolerance) {
    std::unique_ptr<BasicForceRecorder<S>> recorder = context_.make_recorder();
    BasicIntegrationPlan<S> p = plan(tolerance);
    // Explicit methods integrate works by the trapezoidal rule; others leave works out of their error control.
    const bool exact_work = choice_.method == "radau" || choice_.equations == Equations::kIdeal;
    BasicEnergyWatch<S> energy(system_, p.duration, std::max(tolerance, std::min(settings_.tolerance, kLoosestOfMotion)), exact_work, choice_.method == "radau" && !has_constraints(choice_.equations));
    if (p.scale) energy.expect(turnover_);
    p.energy = &energy;
    BasicRingingLoss<S> ringing = fine_ringing_;
    ringing.reset();
    if (context_.shape.checked) p.ringing = &ringing;  // otherwise no error is stated
    instability_.reset();
    if (context_.shape.checked && choice_.equations == Equations::kNewtonian) p.instability = &instability_;
    BasicIntegration<S> done = integrate(system_, start_, p, *recorder);
    count(done.counters);
    const bool complete = done.ended == Ended::kAtEnd || done.ended == Ended::kRunaway;
    interrupted_ = complete ? std::pair{Ended::kAtEnd, std::string()} : std::pair{done.ended, done.message};
    if (!complete && fine_) return false;
    if (coarse_) peaks_before_ = peaks_of(coarse_->loads(), system_.joints.size());
    coarse_ = std::move(fine_);
    if (coarse_) coarse_->keep_forces_only();
    fine_ = std::move(recorder);
    fine_ringing_ = std::move(ringing);
    fine_tolerance_ = tolerance;
    feeder_note_ = energy.note_on_feeder();
    turnover_ = done.ended == Ended::kAtEnd ? energy.turnover() : 0;
    last_ = std::move(done);
    if (last_.ended == Ended::kRunaway) last_.scale = {};  // measured by its loads, the next pass would step over the growth
    return complete;
  }

  void count(const Counters& done) {
    Counters& c = out_.counters;
    c.steps += done.steps;
    c.rejected += done.rejected;
    c.newton_iterations += done.newton_iterations;
    c.newton_failures += done.newton_failures;
    c.evaluations += done.evaluations;
    c.factorizations += done.factorizations;
    c.events += done.events;
    ++c.passes;
  }

  // A pass whose energy account does not close is not compared with others. It is repeated with a smaller tolerance, which may close it.
  bool run_closed_pass(double& tolerance) {
    bool complete = run_pass(tolerance);
    for (; interrupted_.first == Ended::kEnergyOpen && open_ < kMostOpen && tolerance > kLeastTolerance; ++open_) {
      if (last_.ended == Ended::kEnergyOpen) {  // it was the first, and its loads are no scale for the next
        fine_.reset();
        last_.scale = {};
      }
      tolerance = std::max(kLeastTolerance, kRepeated * tolerance);
      complete = run_pass(tolerance);
    }
    return complete;
  }

  // theory/time Eqs. (6.1)-(6.3).
  void make_passes() {
    const double wanted = settings_.tolerance;
    choice_.stages = wanted < kTight ? 5 : 3;
    double tolerance = std::min(wanted, out_.of_motion ? kLoosestOfMotion : has_constraints(choice_.equations) && choice_.method == "dopri5" ? kLoosestIdeal : kLoosest);
    if (!context_.shape.checked) {
      run_pass(tolerance_by_nominal(tolerance));
      return finish();
    }
    if (run_pilot(tolerance)) {
      do {
        const double before = fine_tolerance_, steps_before = static_cast<double>(last_.counters.steps);
        ran_away_ = last_.ended == Ended::kRunaway;
        if (!run_closed_pass(tolerance)) break;
        compare(before, steps_before);
      } while (go_finer(tolerance));
    }
    if (context_.shape.measured != nullptr) *context_.shape.measured = {wanted, fine_tolerance_, choice_.stages, 0, last_.scale};
    finish();
  }

  // `tolerance` is that of the next pass.
  bool run_pilot(double& tolerance) {
    double of_pilot = kPilot * tolerance;
    bool complete = run_closed_pass(of_pilot);
    const Counters& pilot = last_.counters;
    if (complete && choice_.method == "radau" && choice_.stages == 3 && static_cast<double>(pilot.newton_iterations) < kEasy * static_cast<double>(pilot.steps)) {
      choice_.stages = 5;
      complete = run_closed_pass(of_pilot);
      if (!complete && interrupted_.first != Ended::kStopped) {  // keep the pass of three stages, and continue with three
        choice_.stages = 3;
        complete = true;
      }
    }
    stages_before_ = choice_.stages;
    tolerance = std::min(tolerance, of_pilot / kPilot);
    return complete;
  }

  // Compares the last two passes. The coarser one had the tolerance `before` and took `steps_before` steps.
  void compare(double before, double steps_before) {
    const BasicForceTable<S> &coarse = coarse_->forces(), &fine = fine_->forces();
    coarse_before_ = std::exchange(coarse_tolerance_, before);
    alike_ = choice_.stages == stages_before_ && static_cast<double>(last_.counters.steps) < kAlike * steps_before;
    const bool lucky = choice_.method != "radau" && !has_constraints(choice_.equations);  // their tolerances are on states, and forces may be much better in one pass than these ask for
    const bool all = alike_ || lucky || out_.of_motion || last_.sliding_load >= 0 || multiplies_roundoff() || follows_first_;
    share_ = share_while_small_ = all ? 1.0 : share_of_finer(fall_of_errors(before, steps_before));
    stages_before_ = choice_.stages;
    find_difference(coarse, fine);
    out_.motion_error = out_.of_motion ? std::max(motion_difference(system_, coarse, fine), kSurest * fine_tolerance_) : 0;
    relative_difference_ = relative_differences(system_, difference_);
    const double apart = out_.of_motion ? out_.motion_error : largest_of(relative_difference_);
    if (growth_.exponential && growth_.saturated) {
      last_growth_ = growth_;
      error_at_last_growth_ = error_;
      coarse_at_last_growth_ = coarse_before_;
    }
    growth_ = {};
    if (apart > kPromised * settings_.tolerance) growth_ = growth_between(system_, coarse, fine, out_.of_motion, settings_.tolerance, kPromised);
    if (growth_.exponential && growth_.saturated) {
      take_all(coarse, fine);
      ++growths_;
      if (growths_ == 1 || growth_.rate_scatter * steadiest_.rate < steadiest_.rate_scatter * growth_.rate) steadiest_ = growth_;
    }
    stalled_ = error_before_ > 0 && error_ > error_before_;
    const double of_passes = share_ * (out_.of_motion ? out_.motion_error : largest_of(relative_difference_));
    error_before_ = std::exchange(error_, out_.of_motion ? of_passes : std::max(of_passes, largest_ringing_loss(system_, difference_, fine_ringing_, fine_tolerance_)));
  }

  // Errors of the last pass relative to those of the previous one: the ratio of the tolerances, or more if the steps have shrunk by less than this would require.
  double fall_of_errors(double before, double steps_before) const {
    if (longest_ > 0) return std::pow(kShorter, choice_.stages);
    const double of_tolerance = fine_tolerance_ / before;
    if (choice_.method != "radau" || choice_.stages != stages_before_) return of_tolerance;
    const double least = feels_rounding(fine_tolerance_) ? kRepeated : 0;  // part of the error of its steps is roundoff, which no tolerance reduces
    return std::max({least, of_tolerance, std::pow(steps_before / static_cast<double>(last_.counters.steps), choice_.stages + 1)});
  }

  // Whether the motion may have made roundoff, which no tolerance reduces, as large as other errors: those of earlier passes have grown exponentially.
  bool multiplies_roundoff() const { return growths_ > 0 && fine_tolerance_ < kNearRounding; }

  // A difference that has stopped growing does not show which part of it is the finer pass's error.
  void take_all(const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) {
    share_ = 1;
    find_difference(coarse, fine);
    relative_difference_ = relative_differences(system_, difference_);
  }

  void find_difference(const BasicForceTable<S>& coarse, const BasicForceTable<S>& fine) {
    difference_ = difference_of_passes(system_, coarse, fine, fine.t.back(), share_);
    // Other methods on free bodies step over kinks, near which their curves are only approximate.
    if ((choice_.method != "radau" && !has_constraints(choice_.equations)) || coarse.t.back() != fine.t.back()) return;
    include_peaks(fine_->loads(), kNegligible, difference_);
    const std::size_t joints = system_.joints.size();
    include_peak_differences(peaks_before_, peaks_of(coarse_->loads(), joints), peaks_of(fine_->loads(), joints), share_, difference_);
  }

  // Decides whether another pass is made, and sets its tolerance.
  bool go_finer(double& tolerance) {
    const double wanted = settings_.tolerance;
    const auto at = [&tolerance](double next) { return tolerance = std::max(kLeastTolerance, next), true; };
    const int most = out_.counters.steps < kFewSteps ? kMaxShortPasses : kMaxPasses;
    const bool last_one = static_cast<int>(out_.counters.passes) >= most || tolerance <= kLeastTolerance;
    if (last_.ended == Ended::kRunaway || (last_.unbounded_reactions >= 0 && !out_.of_motion)) return false;
    if (((alike_ && !doubted_) || ran_away_) && !last_one) {
      doubted_ = true;
      if (out_.of_motion) choice_.stages = 5;  // long steps are much the same at any tolerance: a different order shows their error
      return at(kRepeated * tolerance);
    }
    const double enough = tolerance < kFinest ? 1 : has_stuck() && tolerance > kNearRounding ? kPromisedStuck : choice_.stages > 3 ? kPromisedByFew : kPromised;  // of the tolerance; 1 where finer passes find roundoff
    if (std::exchange(follows_first_, false) && error_ > wanted) note_on_instability(true);
    if (error_ <= enough * wanted) {
      if (follow_instability()) return at(tolerance);
      // If the passes took nearly the same steps again, the tolerance does not limit them, and that the passes agree is little evidence.
      if (agree_suddenly() && !confirmed_ && !last_one) return confirmed_ = true, at(kRepeated * tolerance);
      if (!alike_ || out_.of_motion || longest_ > 0 || last_one || choice_.method != "radau") return false;
      longest_ = kShorter * settings_.duration / static_cast<double>(last_.counters.steps);
      return at(tolerance);
    }
    const bool same = growth_.saturated && is_steady(growth_) && same_growth(last_growth_, growth_);
    if (same) claim_chaos(growth_);
    if (last_one) return end_far_apart();
    if (growth_.exponential && growth_.saturated) {
      const double hoped = tolerance_by_growth(growth_.rate - kOptimism * growth_.rate_error, 1);
      const bool hopeless = hoped < kLeastTolerance || tolerance < kFinest;
      if (same && hopeless && !errors_fall() && (is_sure() || coarse_tolerance_ <= kFinest || last_.counters.steps > kLong)) return false;
      if (growth_.to_largest) return at(finer_by_error(tolerance));
      const double by_growth = hopeless ? (same ? kFinest : tolerance) : std::max({kFinest, tolerance_by_growth(growth_.rate, kErrorPower), same ? 0 : kLeap * tolerance});
      const double next = std::min(kRepeated * tolerance, by_growth);
      choose_order(next);
      return at(next);
    }
    at_rounding_ = meets_rounding(tolerance) || (last_.sliding_load >= 0 && tolerance <= kNarrowed);
    return at_rounding_ ? end_far_apart() : at(finer_by_error(tolerance));
  }

  // Whether the next pass follows a vibration that the accepted one has damped although it grows; its steps are short then. Asked once.
  bool follow_instability() {
    if (suppressed_) return false;
    suppressed_ = instability_.growing_mode();
    if (!suppressed_) return false;
    const double step = longest_following_step(*suppressed_);
    follows_first_ = settings_.duration < kMostFollowed * step;
    if (follows_first_) longest_ = step;
    else note_on_instability(false);
    return follows_first_;
  }

  void note_on_instability(bool followed) { out_.notes.push_back(note_on_suppressed(*suppressed_, settings_.duration, followed)); }

  // Whether surfaces have come to rest. The force they lock in depends on how they did.
  bool has_stuck() const {
    return std::any_of(last_.crossings.begin(), last_.crossings.end(), [this](const LawCrossing& crossing) {
      return system_.joints[static_cast<std::size_t>(crossing.joint)].law.parts()[static_cast<std::size_t>(crossing.part)]->border_name(crossing.border, crossing.rising) == "sticks";
    });
  }

  // The passes agree far better than their tolerances explain, while the error of the previous ones had not fallen. This may be chance.
  bool agree_suddenly() const { return stalled_ && fine_tolerance_ > kNearRounding && error_ < kSudden * error_before_ * fine_tolerance_ / coarse_tolerance_; }

  static bool is_steady(const ErrorGrowth& growth) { return growth.rate_scatter < kMostScatter * growth.rate; }
  // False for a chaotic motion: its errors are as large as they can be, whatever the tolerance.
  bool errors_fall() const { return error_ < kFalls * error_at_last_growth_; }

  // Whether a motion that shows the same growth twice is chaotic without trying the tightest tolerances. Errors may also grow for a limited time only.
  bool is_sure() const {
    const double shift = (growth_.until - last_growth_.until) * growth_.rate / std::log(coarse_at_last_growth_ / coarse_tolerance_);
    return growth_.to_largest == last_growth_.to_largest && tolerance_by_growth(growth_.rate, 1) < kFarBelow && shift > kShift;
  }

  void claim_chaos(const ErrorGrowth& growth) {
    chaos_ = growth;
    chaos_.rate_error = std::max(growth.rate_error, growth.rate_scatter);
  }

  // Returns false: no finer pass is made. If pairs of passes have grown apart at somewhat different rates, and no later pass has come closer, that is chaos too.
  bool end_far_apart() {
    if (!chaos_.exponential && growths_ > 1 && is_steady(steadiest_) && !errors_fall()) claim_chaos(steadiest_);
    return false;
  }

  // Chooses the order of a pass with this tolerance. Steps between events are short; order 9 makes them longer.
  void choose_order(double tolerance) {
    if (tolerance < kTight && (last_.counters.steps > kCheap || last_.counters.events > 0)) choice_.stages = 5;
  }

  // A long pass that has rejected, for their errors, more than half as many steps as it has taken.
  bool feels_rounding(double tolerance) const { return tolerance < kNearRounding && last_.counters.steps > kLong && 2 * last_.counters.rejected > last_.counters.steps; }
  // Such a pass that has also gained little on the previous one, which was near rounding too.
  bool meets_rounding(double tolerance) const { return feels_rounding(tolerance) && coarse_tolerance_ < kNearRounding && error_before_ > 0 && error_ > kNoGain * error_before_; }

  // The tolerance of the next pass, after one with `tolerance`, that would make the error shown by the last two small enough.
  double finer_by_error(double tolerance) {
    const double shrink = 0.5 * std::pow(settings_.tolerance / error_, 1 / kErrorPower);
    const bool by_tenths = last_.counters.steps > kLong || tolerance < kNearRounding;
    const double least = by_tenths ? std::min(kRepeated * tolerance, kNearRounding) : 0;
    const double next = std::max(least, tolerance * std::clamp(shrink, 1e-3, kRepeated));
    choose_order(next);
    return next;
  }

  // The tolerance with which errors that grow at this rate would be small enough at the end. The difference is the coarser pass's error.
  // theory/time Eq. (6.9).
  double tolerance_by_growth(double rate, double power) const {
    const double at_end = growth_.extrapolated(settings_.duration, rate);
    return coarse_tolerance_ * std::min(1.0, 0.5 * std::pow(settings_.tolerance / at_end, 1 / power));
  }

  // The tolerance of a single pass: that of the usual second pass, or what was enough for the nominal run.
  double tolerance_by_nominal(double second) {
    const BasicNominalRun<S>* nominal = context_.shape.nominal;
    if (nominal == nullptr || !(nominal->wanted > 0)) return second;
    choice_.stages = nominal->stages;
    last_.scale = nominal->scale;
    return std::clamp(nominal->tolerance * settings_.tolerance / nominal->wanted, kLeastTolerance, second);
  }

  // Relative to a joint's peak force. All passes share some errors, such as those of the vibration after friction reverses. Their difference does not
  // show these errors, but the estimates of the steps do.
  double least_error() const { return out_.of_motion ? 0 : fine_tolerance_ * std::min(kSurest, last_.largest_step_error); }

  void finish() {
    fine_->fill(out_);
    out_.events = events_of_joints(system_, last_.crossings, fine_->heat_at_crossings());
    out_.t_end = last_.t;
    out_.notes.insert(out_.notes.end(), last_.remarks.begin(), last_.remarks.end());
    measure_by_peaks();
    const auto worst = std::max_element(relative_difference_.begin(), relative_difference_.end());
    const BasicJointData<S>* worst_joint = worst == relative_difference_.end() ? nullptr : &system_.joints[static_cast<std::size_t>(worst - relative_difference_.begin())];
    judge(worst_joint);
    note_on_motion();
    const std::string torn = note_on_torn_joint(system_, start_, out_.joints);
    if (!torn.empty()) out_.notes.insert(out_.notes.begin(), torn);
    if (!feeder_note_.empty() && (out_.outcome != Outcome::kCompleted || !torn.empty()) && out_.outcome != Outcome::kRunaway) out_.notes.push_back(feeder_note_);
    const bool chaotic = out_.outcome == Outcome::kHorizon;
    for (LoadSummary& joint : out_.joints) joint.horizon = last_.t;
    const BasicLeastError<S> least{least_error(), fine_ringing_, fine_tolerance_};
    if (!difference_.force.empty() && !chaotic) state_errors(system_, difference_, share_, least, out_);
    if (difference_.force.empty() && context_.shape.checked) leave_errors_open();
    if (chaotic) promise_until_horizons(system_, *coarse_, *fine_, share_while_small_, kPromised * settings_.tolerance, least, chaos_, out_);
  }

  // Joint forces may be right where the motion is not, as those of a guide across which nothing is driven.
  void note_on_motion() {
    constexpr double kUnseen = 30;   // multiple of the tolerance: motions farther apart than this are not explained by errors that the forces show
    constexpr double kStill = 1e-3;  // fraction of the mechanism's size: bodies that move less are at rest
    if (out_.of_motion || system_.loads.empty() || !coarse_ || out_.outcome != Outcome::kCompleted) return;
    const double apart = share_ * motion_difference(system_, coarse_->forces(), fine_->forces());
    if (!(apart > kUnseen * settings_.tolerance) || longest_path(system_, fine_->forces()) < kStill * size_about_origin(system_, start_.q)) return;
    out_.notes.push_back(fmt::format("the joint forces hardly depend on it, but two integrations place the bodies up to {:.1g} of their longest path apart: forces of springs and motors that depend on positions are as uncertain. "
                                     "tolerance_of = \"motion\" controls and states the error of the motion", apart));
  }

  // There was no second pass to estimate them.
  void leave_errors_open() {
    for (LoadSummary& joint : out_.joints) joint.error_estimate = joint.moment_error_estimate = joint.relative_error_estimate = std::numeric_limits<double>::quiet_NaN();
  }

  // While passes are made, errors are measured against the forces in the rows and a small part of the peaks between rows: an impact between rows shows little of its error in them.
  // The error stated and judged in the end is relative to the joints' peaks.
  void measure_by_peaks() {
    if (difference_.force.empty()) return;
    include_peaks(fine_->loads(), 1, difference_);
    relative_difference_ = relative_differences(system_, difference_);
    if (!out_.of_motion) error_ = share_ * largest_of(relative_difference_);
  }

  // Up to which time the run meets the tolerance, in words.
  std::string until_missed() const {
    if (out_.of_motion || !coarse_) return "";
    const std::vector<double> horizons = force_horizons(system_, coarse_->forces(), fine_->forces(), share_, settings_.tolerance);
    const double horizon = *std::min_element(horizons.begin(), horizons.end());
    return horizon > 0 && horizon < last_.t ? fmt::format("; up to t = {:.4g} s all are within the tolerance", horizon) : "";
  }

  // Whether the joint's largest error is that of its couple rather than of its force.
  bool is_of_couple(const BasicJointData<S>& joint) const {
    const auto j = static_cast<std::size_t>(&joint - system_.joints.data());
    return share_ * difference_.force[j] < 0.5 * error_ * difference_.peak[j];
  }

  std::string why_not_finer() const {
    if (last_.sliding_load < 0) return "; finer passes are limited by roundoff";
    const BasicLoadData<S>& held = system_.loads[static_cast<std::size_t>(last_.sliding_load)];
    return fmt::format("; {} {} keeps switching where its expression jumps and is held there, with a lag that finer passes hardly reduce", held.applied ? "force" : "motor", held.name);
  }

  // `worst` is not needed for an error of the motion.
  std::string missed_message(const BasicJointData<S>* worst) const {
    std::string what = "position error", of = "the longest path of any body";
    if (!out_.of_motion) {
      const bool couple = is_of_couple(*worst);
      what = fmt::format("{} error, at {} {},", couple ? "couple" : "force", worst->servo < 0 ? "joint" : "motor", worst->name);
      of = couple ? fmt::format("the peak couple, or of {:g} of what the mechanism's forces could make", kNegligible) : "the peak force";
    }
    return fmt::format("the largest {} is estimated at {:.2g} of {}; the tolerance is {:.2g}{}{}", what, error_, of, settings_.tolerance,
                       at_rounding_ ? why_not_finer() : "", until_missed());
  }

  // Sets how the run ended. If a pass broke off, the results are those of the previous one.
  // `worst` is the joint with the largest error; null if there is none, or no estimate.
  void judge(const BasicJointData<S>* worst) {
    const bool no_estimate = worst == nullptr && !(out_.of_motion && coarse_);
    const auto& [ended, message] = interrupted_;
    const bool unbounded = last_.unbounded_reactions >= 0 && !out_.of_motion;
    const bool whole = last_.ended == Ended::kAtEnd, missed = error_ > settings_.tolerance || unbounded;
    if (ended == Ended::kStopped) out_.outcome = Outcome::kInterrupted;
    else if (last_.ended == Ended::kRunaway) out_.outcome = Outcome::kRunaway;
    else if (ended == Ended::kEnergyOpen) out_.outcome = Outcome::kEnergyOpen;
    else if (ended == Ended::kFailed && !whole) out_.outcome = Outcome::kFailed;
    else if (missed && chaos_.exponential && ended == Ended::kAtEnd) out_.outcome = Outcome::kHorizon;
    else if ((ended == Ended::kFailed && no_estimate) || missed) out_.outcome = Outcome::kToleranceNotMet;
    if (no_estimate && context_.shape.checked && !system_.joints.empty()) out_.notes.push_back("stopped before a second integration: the joint forces have no error estimate");
    if (whole && ended != Ended::kAtEnd)
      out_.notes.push_back(fmt::format("a finer integration did not reach the end{}; the results are those of the previous one", message.empty() ? "" : " (" + message + ")"));
    if (out_.outcome == Outcome::kToleranceNotMet && !no_estimate) out_.message = missed_message(worst);
    if (unbounded && out_.outcome == Outcome::kToleranceNotMet) out_.message = fmt::format("the reactions of ideal joints have no bound at the singular position near t = {:.6g} s, whatever the tolerance: give these joints stiffness", last_.unbounded_reactions);
    if (out_.outcome == Outcome::kRunaway) out_.message = last_.message;
    if (!message.empty() && out_.outcome != Outcome::kCompleted) out_.message += (out_.message.empty() ? "" : "; ") + message;
  }

  const BasicSystem<S>& system_;
  const BasicState<S>& start_;
  const SimulateSettings& settings_;
  const BasicPassContext<S>& context_;
  Trajectory& out_;
  BasicRingingLoss<S> fine_ringing_;
  BasicSuppressedInstability<S> instability_;  // of the last pass
  std::optional<SuppressedMode> suppressed_;  // found in it, or in an earlier one
  bool follows_first_ = false;                // the next pass, or the one that has just ended, is the first whose steps follow it
  MethodChoice choice_;
  std::unique_ptr<BasicForceRecorder<S>> coarse_, fine_;
  double fine_tolerance_ = 0, coarse_tolerance_ = 0, coarse_before_ = 0;  // of the last two passes; of the coarser one in the previous comparison
  // Of the last two passes.
  PassDifference difference_;
  JointPeaks peaks_before_;  // of the pass before coarse_
  std::vector<double> relative_difference_;  // of each joint
  double share_while_small_ = 1;                      // share_ of differences that are still far from saturation
  double share_ = 1, error_ = 0, error_before_ = 0;  // of the last two comparisons
  bool stalled_ = false;                              // the error did not fall between the two previous comparisons
  bool confirmed_ = false;                            // a pass has been made to confirm a sudden agreement
  bool at_rounding_ = false;                          // the last pass has not gained on the previous one
  bool alike_ = false;             // they took nearly the same steps
  int stages_before_ = 0;          // of the coarser pass
  ErrorGrowth growth_, last_growth_;  // the latter of the previous pair that showed chaos: one between may be too short or too jagged to tell
  double error_at_last_growth_ = 0, coarse_at_last_growth_ = 0;  // error_ and coarse_tolerance_ of those passes
  int growths_ = 0;                // pairs of passes that have shown chaos
  ErrorGrowth steadiest_;          // the one of these with the least scatter relative to its rate
  ErrorGrowth chaos_;              // where two pairs have shown the same exponential growth
  bool doubted_ = false;           // a pass has been made because two took nearly the same steps
  double longest_ = 0;             // longest step of passes from now on, as tolerances have not shortened the steps [s]
  bool ran_away_ = false;          // the coarser pass
  std::string feeder_note_;        // BasicEnergyWatch::note_on_feeder of the last pass
  double turnover_ = 0;            // energy that the last pass has turned over, if its account closed [J]
  int open_ = 0;                   // passes repeated because the energy account did not close
  BasicIntegration<S> last_;
  std::pair<Ended, std::string> interrupted_{Ended::kAtEnd, ""};
  double reported_ = 0;
};

}  // namespace

template <class S>
std::unique_ptr<BasicForceRecorder<S>> run_passes(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const BasicPassContext<S>& context, Trajectory& out) {
  return Passes<S>(system, start, settings, context, out).go();
}

template std::unique_ptr<ForceRecorder> run_passes(const System& system, const State& start, const SimulateSettings& settings, const BasicPassContext<Planar>& context, Trajectory& out);
PINTLE_IN_SPACE(template std::unique_ptr<BasicForceRecorder<Spatial>> run_passes(const BasicSystem<Spatial>& system, const BasicState<Spatial>& start, const SimulateSettings& settings, const BasicPassContext<Spatial>& context, Trajectory& out);)

}  // namespace pintle
