// Joint forces of the four-bar by penalties and by the augmented Lagrangian, compared with Pintle's own: the table of theory/penalty section 4.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "integrators/general/alpha_stepper.h"
#include "integrators/ideal/augmented_lagrangian.h"
#include "integrators/ideal/tree_augmented.h"

namespace pintle::bench {
namespace {

constexpr int kOutputs = 100;
constexpr int kRepetitions = 5;
constexpr double kTruth = 1e-9, kCompliantTruth = 1e-9;
constexpr double kFactor = 1e3;     // of the penalties in the iteration: small, so that the multipliers converge only as far as the steps let them
constexpr double kNoControl = 1e6;  // a tolerance at which no step is shortened

// Steps of equal length that end at the outputs; with the forces of the state, and the multipliers at the end of the iteration.
struct FixedSteps {
  Samples forces, multipliers;
  double seconds = 0, steps = 0;
};

FixedSteps fixed_steps(const Problem& problem, const AlphaWeights& weights, bool relative, int per_output) {
  FixedSteps out{Samples(*problem.system), Samples(*problem.system)};
  auto kept = std::make_unique<AugmentedLagrangian>(*problem.system, kFactor);
  const AugmentedLagrangian& inside = *kept;
  const Stopwatch watch;
  std::unique_ptr<Stepper> stepper;
  if (relative) stepper = std::make_unique<TreeAugmented>(*problem.system, weights, kNoControl);
  else stepper = std::make_unique<AlphaStepper>(*problem.system, weights, kNoControl, std::move(kept));
  double begin = 0;
  stepper->start(*problem.start, problem.outputs.front() / per_output);
  for (const double end : problem.outputs) {
    stepper->set_max_step((end - begin) / per_output * (1 + 1e-12));
    while (stepper->state().t < end)
      if (!stepper->step(end)) throw std::runtime_error(stepper->failure());
    const State& now = stepper->state();
    out.forces.add(now.q, now.v, now.force);
    if (!relative) out.multipliers.add(now.q, now.v, inside.force());
    begin = end;
  }
  out.seconds = watch.seconds();
  out.steps = static_cast<double>(stepper->counters().steps);
  return out;
}

class Study {
 public:
  Study(const std::string& title, const std::vector<std::string>& overrides)
      : compliant_(of(Equations::kNewtonian, overrides)), ideal_(of(Equations::kIdeal, overrides)), compliant_problem_(compliant_.problem(kOutputs)), ideal_problem_(ideal_.problem(kOutputs)), table_(table(title)) {}

  nlohmann::ordered_json go() {
    const Samples truth = run_stepper(ideal_problem_, {Equations::kIdeal, "dopri5"}, kTruth).samples;
    const Samples compliant = run_stepper(compliant_problem_, {Equations::kNewtonian, "radau", 5}, kCompliantTruth).samples;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) add("compliant joints, radau", tolerance, compliant_problem_, {Equations::kNewtonian, "radau", 3}, compliant);
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) add("multipliers, dopri5", tolerance, ideal_problem_, {Equations::kIdeal, "dopri5"}, truth);
    for (const auto& [factor, frequency] : {std::pair{1e5, 10.0}, {1e7, 10.0}, {1e9, 10.0}, {1e7, 100.0}, {1e9, 100.0}}) add_penalty(factor, frequency, truth);
    for (const bool relative : {false, true})
      for (const auto& [rule, weights] : {std::pair{"trapezoidal", AlphaWeights::trapezoidal()}, {"HHT", AlphaWeights::hht(-0.05)}})
        for (const int per_output : {1, 2, 4, 8, 16}) add_augmented(rule, weights, relative, per_output, truth);
    table_.print();
    return table_.json();
  }

 private:
  static ReadyModel of(Equations equations, const std::vector<std::string>& overrides) {
    Model model = collection_model("four_bar", overrides);
    model.simulate.equations = equations;
    return ReadyModel(std::move(model));
  }

  static ResultTable table(const std::string& title) {
    return {title, {{"method", "method", true}, {"setting", "setting", true}, {"steps", "steps"}, {"ms", "milliseconds"}, {"force error", "force_error"}, {"of multipliers", "multiplier_error"}}};
  }

  void row(const std::string& method, const std::string& setting, double steps, double seconds, double error, double of_iteration) {
    table_.add_row({text(method), text(setting), count(steps), number(1e3 * seconds, "{:.2f}"), number(error, "{:.1e}"), number(of_iteration, "{:.1e}")});
  }

  void add_run(const std::string& method, const std::string& setting, double tolerance, const Problem& problem, const MethodChoice& choice, const Samples& truth) {
    PintleRun run = run_stepper(problem, choice, tolerance);
    for (int i = 1; i < kRepetitions; ++i) run.seconds = std::min(run.seconds, run_stepper(problem, choice, tolerance).seconds);
    row(method, setting, static_cast<double>(run.counters.steps), run.seconds, run.samples.error(truth), NAN);
  }

  void add(const std::string& method, double tolerance, const Problem& problem, const MethodChoice& choice, const Samples& truth) {
    add_run(method, fmt::format("tolerance {:.0e}", tolerance), tolerance, problem, choice, truth);
  }

  void add_penalty(double factor, double frequency, const Samples& truth) {
    MethodChoice choice{Equations::kPenalty, "dopri5"};
    choice.penalty = {factor, frequency, 1};
    constexpr double kFine = 1e-8;  // only the error of the penalties remains
    add_run("penalty, dopri5", fmt::format("{:.0e}, {:g} rad/s", factor, frequency), kFine, ideal_problem_, choice, truth);
  }

  void add_augmented(const char* rule, const AlphaWeights& weights, bool relative, int per_output, const Samples& truth) {
    FixedSteps run = fixed_steps(ideal_problem_, weights, relative, per_output);
    for (int i = 1; i < kRepetitions; ++i) run.seconds = std::min(run.seconds, fixed_steps(ideal_problem_, weights, relative, per_output).seconds);
    row(fmt::format("augmented{}, {}", relative ? ", relative" : "", rule), fmt::format("steps of {:.2g} ms", 1e3 * ideal_problem_.outputs.front() / per_output), run.steps, run.seconds,
        run.forces.error(truth), run.multipliers.error(truth));
  }

  ReadyModel compliant_, ideal_;
  Problem compliant_problem_, ideal_problem_;
  ResultTable table_;
};

}  // namespace

nlohmann::ordered_json study_constraints() {
  return {{"four_bar", Study("Four-bar, one turn of the crank", {}).go()}, {"light_crank", Study("The same with a light crank, whose motion depends on the forces", {"body.crank.inertia=1"}).go()}};
}

}  // namespace pintle::bench
