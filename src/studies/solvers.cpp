// Every method at every tolerance against one tight run. theory/solvers section 5.
#include "pintle/solvers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/stopwatch.h"
#include "check/modes/check_frequencies.h"
#include "integrators/methods.h"
#include "pintle/simulate.h"
#include "run/integration.h"
#include "run/pass_constants.h"
#include "run/recorder.h"
#include "run/recording.h"
#include "start/start.h"
#include "studies/joint_errors.h"

namespace pintle {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kWindowSteps = 20, kWindowPeriods = 3;  // width of the running mean, in output steps and in periods
constexpr double kWindowMost = 0.25;                     // upper limit on it, as a fraction of the duration
constexpr double kAboveTruth = 10, kTooCoarse = 0.3;     // errors above kAboveTruth times that of the truth and below kTooCoarse are used for the order
constexpr int kRepetitions = 5;
constexpr double kShort = 0.05;                          // upper limit on the time of runs that are repeated [s]
constexpr double kStepsRatio = 2;                        // lower limit on the ratio of steps between the runs from which the order is taken

// Methods of enforcing constraints; the first is used for the truth.
struct ConstraintMethod {
  const char* word;
  Equations equations;
  const char* method;
};
constexpr std::array<ConstraintMethod, 7> kConstraintMethods{{{"multipliers", Equations::kIdeal, "dopri5"},
                                                              {"penalty", Equations::kPenalty, "dopri5"},
                                                              {"penalty_trapezoidal", Equations::kPenalty, "ode23t"},
                                                              {"augmented_lagrangian", Equations::kAugmentedLagrangian, "ode23t"},
                                                              {"augmented_lagrangian_hht", Equations::kAugmentedLagrangian, "hht"},
                                                              {"relative_augmented_lagrangian", Equations::kRelativeAugmented, "ode23t"},
                                                              {"relative_augmented_lagrangian_hht", Equations::kRelativeAugmented, "hht"}}};

MethodChoice method_choice(const Model& model, const std::string& word, double tolerance) {
  MethodChoice choice{Equations::kNewtonian, word, tolerance < kTight ? 5 : 3};
  for (const ConstraintMethod& way : kConstraintMethods)
    if (has_constraints(model.simulate.equations) && word == way.word) choice = {way.equations, way.method};
  choice.penalty = model.simulate.penalty;
  return choice;
}

void check_options(const Model& model, const SolverStudyOptions& options) {
  const std::vector<std::string> known = solver_methods(model.simulate.equations);
  if (known.empty()) throw std::invalid_argument("methods are compared on joints that are force laws, or ideal joints: equations = \"newtonian\" or \"ideal\"");
  for (const std::string& method : options.methods)
    if (std::find(known.begin(), known.end(), method) == known.end())
      throw std::invalid_argument(fmt::format("there is no method {} for {} equations", method, to_word(model.simulate.equations)));
  for (const double tolerance : options.tolerances)
    if (!(tolerance > 0 && tolerance < 1)) throw std::invalid_argument(fmt::format("a tolerance of {:g} is not between 0 and 1", tolerance));
}

Model as_studied(Model model, const SolverStudyOptions& options) {
  check_options(model, options);
  model.simulate.record = {"all"};
  return model;
}

class Study {
 public:
  Study(const Model& model, const SolverStudyOptions& options, const KeepGoing& keep_going)
      : model_(as_studied(model, options)), options_(options), keep_going_(keep_going), start_(start_of_run(model_)) {}

  SolverStudy go() {
    model_.simulate.output_step = output_step_of(model_.simulate, start_.system.joints.size());
    out_.duration = model_.simulate.duration;
    out_.output_step = model_.simulate.output_step;
    find_truth();
    if (!out_.truth.complete) return std::move(out_);
    choose_window();
    for (const std::string& method : options_.methods.empty() ? solver_methods(model_.simulate.equations) : options_.methods) try_method(method);
    return std::move(out_);
  }

 private:
  bool go_on() {
    if (keep_going_ && !keep_going_()) out_.interrupted = true;
    return !out_.interrupted;
  }

  bool constrained() const { return has_constraints(model_.simulate.equations); }

  void find_truth() {
    Model model = model_;
    if (constrained()) model.simulate.equations = Equations::kIdeal;
    model.simulate.method = "auto";
    model.simulate.tolerance = options_.truth_tolerance;
    truth_ = simulate(model, [this](const Progress&) { return go_on(); });
    SolverTruth& truth = out_.truth;
    truth.method = truth_.method;
    truth.tolerance = options_.truth_tolerance;
    truth.complete = truth_.outcome == Outcome::kCompleted || truth_.outcome == Outcome::kToleranceNotMet;
    truth.message = truth_.message;
    truth.seconds = truth_.wall_seconds;
    for (const LoadSummary& joint : truth_.joints) truth.error_estimate = std::max(truth.error_estimate, joint.relative_error_estimate);
  }

  void choose_window() {
    const CheckFrequencies frequencies = constrained() ? CheckFrequencies{} : check_frequencies(start_.system, start_.state, -1);
    for (const CheckComponent& c : frequencies.components)
      if (c.frequency > 0) out_.slowest_vibration = out_.slowest_vibration > 0 ? std::min(out_.slowest_vibration, c.frequency) : c.frequency;
    const double periods = out_.slowest_vibration > 0 ? kWindowPeriods * 2 * std::numbers::pi / out_.slowest_vibration : 0;
    const double window = std::clamp(std::max(periods, kWindowSteps * out_.output_step), 0.0, kWindowMost * out_.duration);
    half_window_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(0.5 * window / out_.output_step)));
    out_.window = 2 * static_cast<double>(half_window_) * out_.output_step;
  }

  void try_method(const std::string& method) {
    if (const std::string reason = why_not(method_choice(model_, method, 1)); !reason.empty()) {
      out_.notes.push_back(reason);
      return;
    }
    for (const double tolerance : options_.tolerances)
      if (go_on()) out_.runs.push_back(measure(method, tolerance));
    out_.orders.push_back(order_of(method));
  }

  IntegrationPlan plan(const std::string& method, double tolerance) const {
    IntegrationPlan p;
    p.duration = out_.duration;
    p.output_step = out_.output_step;
    p.max_step = model_.simulate.max_step;
    p.tolerance = tolerance;
    p.first_step = 1e-4 * p.duration;
    p.choice = method_choice(model_, method, tolerance);
    return p;
  }

  SolverRun measure(const std::string& method, double tolerance) {
    SolverRun run;
    run.method = method;
    run.tolerance = tolerance;
    Recorder recorder(model_, start_.system);
    IntegrationPlan p = plan(method, tolerance);
    const Stopwatch clock;
    p.keep_going = [&](double) { return clock.seconds() < options_.time_limit && go_on(); };
    const Integration done = integrate(start_.system, start_.state, p, recorder);
    run.seconds = clock.seconds();
    run.t_end = done.t;
    run.message = done.message;
    run.steps = static_cast<double>(done.counters.steps);
    run.rejected = static_cast<double>(done.counters.rejected);
    run.evaluations = static_cast<double>(done.counters.evaluations);
    run.newton_iterations = static_cast<double>(done.counters.newton_iterations);
    run.factorizations = static_cast<double>(done.counters.factorizations);
    if (done.ended == Ended::kFailed) run.end = SolverEnd::kFailed;
    if (done.ended == Ended::kStopped) run.end = out_.interrupted ? SolverEnd::kInterrupted : SolverEnd::kOutOfTime;
    if (run.end == SolverEnd::kOutOfTime) run.message = fmt::format("more than {:g} s", options_.time_limit);
    Trajectory trajectory;
    recorder.fill(trajectory);
    judge(trajectory, run);
    if (run.end == SolverEnd::kCompleted) find_least_time(method, tolerance, run);
    return run;
  }

  // Short runs are repeated, and the shortest time counts: other work of the machine only adds to it.
  void find_least_time(const std::string& method, double tolerance, SolverRun& run) const {
    const double first = run.seconds;
    for (int i = 1; i < kRepetitions && first < kShort; ++i) {
      Recorder recorder(model_, start_.system);
      const Stopwatch clock;
      integrate(start_.system, start_.state, plan(method, tolerance), recorder);
      run.seconds = std::min(run.seconds, clock.seconds());
    }
  }

  void judge(const Trajectory& trajectory, SolverRun& run) const {
    if (run.end != SolverEnd::kCompleted) {
      run.force_error = run.position_error = run.angle_error = run.vibration = run.vibration_of_peak = run.energy_drift = kUnknown;
      return;
    }
    const JointErrors errors(truth_, start_.system.largest_radius_of_gyration());
    const JointErrors::Worst force = errors.force_error(trajectory), vibration = errors.vibration(trajectory, half_window_);
    const auto positions = errors.position_errors(trajectory);
    run.force_error = force.relative;
    run.worst_joint = force.joint;
    run.position_error = positions[0];
    run.angle_error = positions[1];
    run.vibration = vibration.absolute;
    run.vibration_of_peak = vibration.relative;
    run.vibrating_joint = vibration.joint;
    run.energy_drift = trajectory.energy.drift;
  }

  // Least squares of log(error) over log(steps). If stability limits the steps, their number hardly changes and gives
  // no order.
  SolverOrder order_of(const std::string& method) const {
    SolverOrder order{method, 0, kUnknown};
    double sx = 0, sy = 0, sxx = 0, sxy = 0, least = 1e300, most = 0;
    for (const SolverRun& run : out_.runs) {
      const bool telling = run.method == method && run.end == SolverEnd::kCompleted &&
                           (method != "radau" || run.tolerance >= kTight) &&  // only runs of the same order
                           run.force_error > kAboveTruth * out_.truth.error_estimate && run.force_error < kTooCoarse;
      if (!telling) continue;
      const double x = std::log(run.steps), y = std::log(run.force_error);
      ++order.runs;
      least = std::min(least, run.steps);
      most = std::max(most, run.steps);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    const double n = order.runs, spread = n * sxx - sx * sx;
    if (order.runs > 1 && most >= kStepsRatio * least) order.order = -(n * sxy - sx * sy) / spread;
    return order;
  }

  Model model_;
  const SolverStudyOptions& options_;
  const KeepGoing& keep_going_;
  const Assembly start_;
  Trajectory truth_;
  std::size_t half_window_ = 1;
  SolverStudy out_;
};

}  // namespace

std::vector<std::string> solver_methods(Equations equations) {
  if (equations == Equations::kNewtonian) return {"radau", "dopri5", "ode45", "ode23t", "ode15s", "ode113", "hht", "generalised_alpha"};
  std::vector<std::string> words;
  if (has_constraints(equations))
    for (const ConstraintMethod& way : kConstraintMethods) words.push_back(way.word);
  return words;
}

SolverStudy compare_solvers(const Model& model, const SolverStudyOptions& options, const KeepGoing& keep_going) {
  return Study(model, options, keep_going).go();
}

}  // namespace pintle
