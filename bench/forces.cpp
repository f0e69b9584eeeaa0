// Are the joint forces as accurate as requested, and is the error that a run states the true one?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "bench/commands.h"
#include "bench/joint_errors.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"

namespace pintle::bench {
namespace {

constexpr double kReferenceShare = 0.01;  // tolerance of the reference relative to the run's
constexpr double kRounding = 1e-12;  // smaller errors are roundoff of the largest forces and are not judged
constexpr double kLeastRatio = 1.0 / 3, kLargestRatio = 30;

std::vector<std::string> collection() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(PINTLE_SOURCE_DIR) + "/mechanisms"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool accurate(const JointError& e, double tolerance) {
  return e.error <= tolerance;
}

bool honest(const JointError& e) {
  return e.error <= kRounding || (e.ratio() >= kLeastRatio && e.ratio() <= kLargestRatio);
}

std::string name_of(const JointError& e) {
  return e.couple ? e.joint + " (couple)" : e.joint;
}

// Runs of one model, each made only once: a tight run is the reference of a coarse one and is itself measured.
class Runs {
 public:
  Runs(std::string name, double cap) : model_(collection_model(name)), cap_(cap) {}

  const Model& model() const { return model_; }

  const Trajectory& at(double tolerance) {
    const int key = static_cast<int>(std::lround(-10 * std::log10(tolerance)));
    if (const auto known = runs_.find(key); known != runs_.end()) return known->second;
    Model model = model_;
    model.simulate.tolerance = tolerance;
    const double cap = cap_;
    return runs_[key] = simulate(model, [cap](const Progress& p) { return p.wall_seconds < cap; });
  }

 private:
  Model model_;
  double cap_;
  std::map<int, Trajectory> runs_;
};

struct Tally {
  int cases = 0, accurate = 0, honest = 0, skipped = 0, accurate_force = 0;
  void add(const JointError& e, double tolerance) {
    ++cases;
    accurate += bench::accurate(e, tolerance);
    honest += bench::honest(e);
    accurate_force += e.of_force <= tolerance;
  }
};

const char* outcome_word(const Trajectory& run) {
  switch (run.outcome) {
    case Outcome::kCompleted:
      return "";
    case Outcome::kToleranceNotMet:
      return "run says: not met";
    case Outcome::kHorizon:
      return "run says: chaotic";
    case Outcome::kInterrupted:
      return "over the time cap";
    default:
      return "failed";
  }
}

class Study {
 public:
  explicit Study(const ForceOptions& options) : options_(options) {}

  void measure(const std::string& name) {
    Runs runs(name, options_.cap);
    for (const double tolerance : options_.tolerances) {
      const Trajectory& run = runs.at(tolerance);
      if (run.outcome == Outcome::kInterrupted || run.outcome == Outcome::kFailed) {
        skip(name, tolerance, run, outcome_word(run));
        continue;
      }
      const Trajectory& reference = runs.at(kReferenceShare * tolerance);
      const bool usable = reference.outcome == Outcome::kCompleted || reference.outcome == Outcome::kToleranceNotMet;
      const std::vector<JointError> errors =
          usable ? joint_errors(runs.model(), run, reference, options_.negligible) : std::vector<JointError>{};
      if (errors.empty())
        skip(name, tolerance, run, fmt::format("reference {}", outcome_word(reference)));
      else
        add(name, tolerance, run, reference, errors);
    }
  }

  nlohmann::ordered_json finish() {
    table_.print();
    if (options_.every_joint) joints_.print();
    ResultTable summary("How many keep their promises", {{"counted", "counted", true},
                                                         {"cases", "cases"},
                                                         {"error <= tolerance", "accurate"},
                                                         {"without couples", "accurate_force"},
                                                         {"1/3 <= stated/true <= 30", "honest"},
                                                         {"skipped", "skipped"}});
    const auto line = [&summary](const char* what, const Tally& t) {
      summary.add_row(
          {text(what), count(t.cases), count(t.accurate), count(t.accurate_force), count(t.honest), count(t.skipped)});
    };
    line("worst joint of each model and tolerance", models_);
    line("every joint", all_);
    summary.print();
    return {{"worst", table_.json()}, {"joints", joints_.json()}, {"summary", summary.json()}};
  }

 private:
  void skip(const std::string& name, double tolerance, const Trajectory& run, const std::string& why) {
    ++models_.skipped;
    all_.skipped += static_cast<int>(run.joints.size());
    table_.add_row({text(name), number(tolerance, "{:.0e}"), text("-"), number(NAN, ""), number(NAN, ""),
                    number(NAN, ""), number(NAN, ""), count(static_cast<double>(run.counters.passes)),
                    count(static_cast<double>(run.counters.steps)), number(1e3 * run.wall_seconds, "{:.1f}"),
                    text("skipped: " + why)});
  }

  void add(const std::string& name, double tolerance, const Trajectory& run, const Trajectory& reference,
           const std::vector<JointError>& errors) {
    const JointError& worst = worst_of(errors);
    int dishonest = 0;
    for (const JointError& e : errors) {
      all_.add(e, tolerance);
      dishonest += !honest(e);
      joints_.add_row({text(name), number(tolerance, "{:.0e}"), text(name_of(e)), number(e.error / tolerance, "{:.2g}"),
                       number(e.ratio(), "{:.2g}"), text(accurate(e, tolerance) ? "" : "ERROR"),
                       text(honest(e) ? "" : "ESTIMATE")});
    }
    models_.add(worst, tolerance);
    std::string verdict = accurate(worst, tolerance) ? "ok" : "ERROR";
    if (!honest(worst)) verdict += " ESTIMATE";
    if (dishonest > 0) verdict += fmt::format(", {} of {} joints misjudged", dishonest, errors.size());
    if (*outcome_word(run)) verdict += fmt::format(", {}", outcome_word(run));
    if (*outcome_word(reference)) verdict += ", reference not met";
    table_.add_row({text(name), number(tolerance, "{:.0e}"), text(name_of(worst)), number(worst.error, "{:.1e}"),
                    number(worst.error / tolerance, "{:.2g}"), number(worst.estimate, "{:.1e}"),
                    number(worst.ratio(), "{:.2g}"), count(static_cast<double>(run.counters.passes)),
                    count(static_cast<double>(run.counters.steps)), number(1e3 * run.wall_seconds, "{:.1f}"),
                    text(verdict)});
  }

  const ForceOptions& options_;
  ResultTable table_{
      "Joint-force error against a run with a 100 times smaller tolerance: the worst joint of each model",
      {{"model", "model", true},
       {"tolerance", "tolerance"},
       {"joint", "joint", true},
       {"error", "error"},
       {"/tolerance", "error_over_tolerance"},
       {"stated", "stated"},
       {"stated/true", "stated_over_true"},
       {"passes", "passes"},
       {"steps", "steps"},
       {"ms", "milliseconds"},
       {"verdict", "verdict", true}}};
  ResultTable joints_{"Every joint",
                      {{"model", "model", true},
                       {"tolerance", "tolerance"},
                       {"joint", "joint", true},
                       {"error/tolerance", "error_over_tolerance"},
                       {"stated/true", "stated_over_true"},
                       {"error", "error_verdict", true},
                       {"estimate", "estimate_verdict", true}}};
  Tally models_, all_;
};

}  // namespace

nlohmann::ordered_json study_forces(const ForceOptions& options) {
  Study study(options);
  for (const std::string& name : options.models.empty() ? collection() : options.models) {
    fmt::print(stderr, "forces: {}\n", name);
    study.measure(name);
  }
  return study.finish();
}

}  // namespace pintle::bench
