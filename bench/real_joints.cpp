// The cost of real joints: clearance in one pin and friction in all pins compared with the same mechanism without them, and clearance compared with a
// general stiff solver that locates the roots of its contacts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "pintle/simulate.h"
#include "pintle/solvers.h"

namespace pintle::bench {
namespace {

using Overrides = std::vector<std::string>;

struct Pair {
  std::string what, model;
  Overrides both, real, plain;
};

Overrides rubbing(const std::string& friction) {
  Overrides changes;
  for (const char* joint : {"O2", "A", "B", "O4"})
    for (const std::string& key : {"friction=\"" + friction + "\"", std::string("pin_radius=\"10 mm\""), std::string("friction_coefficient=0.1")}) changes.push_back(std::string("joint.") + joint + "." + key);
  return changes;
}

std::vector<Pair> pairs(double tolerance) {
  const std::string at = fmt::format("simulate.tolerance={:g}", tolerance);
  std::vector<Pair> all{{"one pin with clearance", "slider_crank_clearance", {at, "simulate.output_step=1e-4"}, {}, {"--law joint.B=linear"}},
                        {"one pin with clearance, slow", "four_bar_clearance", {at}, {}, {"--law joint.B=linear"}}};
  for (const char* friction : {"lugre", "coulomb", "brown-mcphee", "stribeck"}) all.push_back({fmt::format("{} friction in all pins", friction), "four_bar", {at}, rubbing(friction), {}});
  return all;
}

Overrides together(const Overrides& a, const Overrides& b) {
  Overrides all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

// Whole runs, measured alternately.
class Timed {
 public:
  explicit Timed(Model model) : model_(std::move(model)) {}
  void take_turn() {
    const Stopwatch watch;
    const Trajectory run = simulate(model_);
    times_.add(watch.seconds());
    if (run.outcome != Outcome::kCompleted) throw std::runtime_error(model_.name + ": " + run.message);
    steps_ = static_cast<double>(run.counters.steps);
  }
  double per_second() const { return times_.median() / model_.simulate.duration; }  // of model time [-]
  double steps() const { return steps_; }

 private:
  Model model_;
  Times times_;
  double steps_ = 0;
};

ResultTable costs(double tolerance, int rounds) {
  ResultTable table(fmt::format("Whole runs at tolerance {:g}: milliseconds per second of model time", tolerance),
                    {{"joints", "joints", true}, {"model", "model", true}, {"without", "plain_ms"}, {"with", "real_ms"}, {"ratio", "ratio"}, {"steps without", "plain_steps"}, {"with", "real_steps"}});
  for (const Pair& pair : pairs(tolerance)) {
    Timed plain(collection_model(pair.model, together(pair.both, pair.plain))), real(collection_model(pair.model, together(pair.both, pair.real)));
    for (int round = 0; round < rounds; ++round) {
      plain.take_turn();
      real.take_turn();
    }
    table.add_row({text(pair.what), text(pair.model), number(1e3 * plain.per_second(), "{:.1f}"), number(1e3 * real.per_second(), "{:.1f}"), number(real.per_second() / plain.per_second(), "{:.1f}"),
                   count(plain.steps()), count(real.steps())});
  }
  return table;
}

// The least time [s] of a method's runs that have at least this accuracy.
double time_for(const SolverStudy& study, const std::string& method, double error) {
  double least = std::numeric_limits<double>::infinity();
  for (const SolverRun& run : study.runs)
    if (run.method == method && run.end == SolverEnd::kCompleted && run.force_error <= error) least = std::min(least, run.seconds);
  return std::isfinite(least) ? least : std::numeric_limits<double>::quiet_NaN();
}

ResultTable against_bdf(double cap) {
  ResultTable table("Clearance beside SUNDIALS' BDF with root finding: the cheapest of its runs that reaches a force error",
                    {{"model", "model", true}, {"force error", "error"}, {"radau, ms", "radau_ms"}, {"BDF, ms", "bdf_ms"}, {"ratio", "ratio"}});
  for (const auto& [name, changes] : {std::pair{"slider_crank_clearance", Overrides{"simulate.output_step=1e-4"}}, std::pair{"four_bar_clearance", Overrides{}}}) {
    SolverStudyOptions options;
    options.methods = {"radau", "ode15s"};
    options.tolerances = {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8};
    options.time_limit = cap;
    const SolverStudy study = compare_solvers(collection_model(name, changes), options);
    for (const double error : {1e-2, 1e-3, 1e-4}) {
      const double ours = time_for(study, "radau", error), bdf = time_for(study, "ode15s", error);
      table.add_row({text(name), number(error, "{:.0e}"), number(1e3 * ours, "{:.1f}"), number(1e3 * bdf, "{:.1f}"), number(bdf / ours, "{:.0f}")});
    }
  }
  return table;
}

}  // namespace

nlohmann::ordered_json study_real_joints(const RealJointOptions& options) {
  nlohmann::ordered_json out;
  for (const double tolerance : options.tolerances) {
    const ResultTable table = costs(tolerance, options.rounds);
    table.print();
    out["costs"].push_back(table.json());
  }
  const ResultTable peers = against_bdf(options.cap);
  peers.print();
  out["bdf"] = peers.json();
  return out;
}

}  // namespace pintle::bench
