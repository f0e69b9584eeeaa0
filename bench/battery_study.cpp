// pintle-bench battery: random mechanisms, and whether their runs keep their promises.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "base/stopwatch.h"
#include "bench/battery/battery.h"
#include "bench/commands.h"
#include "bench/result_table.h"

namespace pintle::bench {
namespace {

constexpr int kShown = 5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

const char* exit_word(const MeasuredRun& run) {
  if (run.ended == MeasuredRun::Ended::kRefused) return "refused";
  if (run.ended == MeasuredRun::Ended::kHung) return "-";
  if (run.ended == MeasuredRun::Ended::kThrew) return "1";
  switch (run.outcome) {
    case Outcome::kCompleted: return "0";
    case Outcome::kToleranceNotMet: return "7";
    case Outcome::kFailed: return "5";
    case Outcome::kHorizon: return "9";
    case Outcome::kRunaway: return "10";
    case Outcome::kEnergyOpen: return "11";
    default: return "-";
  }
}

void write_file(const std::filesystem::path& path, const std::string& words) {
  std::ofstream file(path, std::ios::binary);
  file << words;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

class Battery {
 public:
  explicit Battery(const BatteryOptions& options) : options_(options) {
    limits_.run = options.cap;
    limits_.truth = 3 * options.cap;
    limits_.truth_tolerance = options.truth;
    if (options.folder.empty()) return;
    std::filesystem::create_directories(options.folder);
    list_.open(std::filesystem::path(options.folder) / "runs.csv");
    list_ << "model,tolerance,exit_code,fault,joint,error,error_of_truth,stated,joints,honest_joints,passes,steps,seconds,message\n";
  }

  void measure(int number) {
    const RandomMechanism mechanism = random_mechanism(options_.seed, number, options_.kinds);
    if (options_.verbose) fmt::print(stderr, "{}\n", mechanism.name);
    const TrueMotion truth = true_motion(mechanism, limits_);
    if (!truth.jump.empty()) jumps_.push_back({mechanism.name, truth.jump, truth.jump_size});
    int faults = !truth.refused.empty() || !truth.jump.empty();
    for (const MeasuredRun& run : measure_mechanism(mechanism, truth, number, limits_)) {
      tallies_[{run.kind, -run.tolerance}].add(run);
      const Fault fault = fault_of(run);
      if (run.ended == MeasuredRun::Ended::kRefused) refused_.push_back(mechanism.name + ": " + truth.refused);
      else if (!fault.what.empty()) faults_.push_back({fault, run}), ++faults;
      add_to_list(run);
    }
    if (faults > 0 && !options_.folder.empty()) write_file(std::filesystem::path(options_.folder) / (mechanism.name + ".toml"), mechanism.text);
  }

  nlohmann::ordered_json finish() {
    const ResultTable kinds = table_of_kinds(), worst = table_of_faults(kShown);
    kinds.print();
    if (!worst.empty()) worst.print();
    if (!options_.folder.empty()) {
      const ResultTable all = table_of_faults(faults_.size());
      write_file(std::filesystem::path(options_.folder) / "battery.md", kinds.markdown() + "\n" + all.markdown());
    }
    fmt::print("Of {} joints in runs that finished, {} have a stated error of 1/3 to 30 times the true one.\n", sum_.joints, sum_.honest_joints);
    for (const Jump& jump : jumps_) fmt::print("{}: the first row of joint {} is {:.1e} of its peak off the next ones\n", jump.name, jump.joint, jump.size);
    for (const std::string& words : refused_) fmt::print("refused: {}\n", words);
    return {{"kinds", kinds.json()}, {"worst", worst.json()}};
  }

 private:
  struct Jump {
    std::string name, joint;
    double size;
  };

  ResultTable table_of_kinds() {
    ResultTable table("Random mechanisms: runs that keep their promises", {{"kind", "kind", true}, {"tolerance", "tolerance"}, {"runs", "runs"}, {"judged", "judged"}, {"over, exit 0 or 9", "over"},
                                                                           {"stated < 1/3 of true", "too_little"}, {"stated > 30 of true", "too_much"}, {"exit 7", "exit_7"}, {"exit 9", "exit_9"}, {"exit 5", "exit_5"},
                                                                           {"exit 10, 11", "exit_10_11"}, {"over time", "hung"}, {"refused", "refused"}});
    sum_ = {};
    const auto row = [&table](const std::string& kind, double tolerance, const BatteryTally& t) {
      table.add_row({text(kind), number(tolerance, "{:.0e}"), count(t.runs), count(t.judged), count(t.over), count(t.too_little), count(t.too_much), count(t.missed), count(t.chaotic), count(t.failed), count(t.other),
                     count(t.hung), count(t.refused)});
    };
    for (const MechanismKind& kind : mechanism_kinds())
      for (const auto& [key, tally] : tallies_)
        if (key.first == kind.word) row(kind.word, -key.second, tally), sum_.add(tally);
    row("all", kNone, sum_);
    return table;
  }

  ResultTable table_of_faults(std::size_t most) {
    std::stable_sort(faults_.begin(), faults_.end(), [](const auto& a, const auto& b) { return a.first.badness > b.first.badness; });
    ResultTable table("The worst", {{"model", "model", true}, {"tolerance", "tolerance"}, {"what", "what", true}, {"exit code", "exit_code", true}, {"joint", "joint", true}, {"error/tolerance", "error_over_tolerance"},
                                    {"stated/true", "stated_over_true"}, {"passes", "passes"}, {"steps", "steps"}, {"seconds", "seconds"}});
    for (std::size_t i = 0; i < std::min(most, faults_.size()); ++i) {
      const auto& [fault, run] = faults_[i];
      const JointError& e = run.worst;
      table.add_row({text(run.name), number(run.tolerance, "{:.0e}"), text(fault.what), text(exit_word(run)), text(e.joint), number(run.judged ? e.error / run.tolerance : kNone, "{:.2g}"),
                     number(run.judged ? e.ratio() : kNone, "{:.2g}"), count(static_cast<double>(run.passes)), count(static_cast<double>(run.steps)), number(run.seconds, "{:.2f}")});
    }
    return table;
  }

  // Line by line, so that the list can be read while the battery runs.
  void add_to_list(const MeasuredRun& r) {
    if (!list_.is_open()) return;
    list_ << fmt::format("{},{:.0e},{},{},{},{:.3e},{:.3e},{:.3e},{},{},{},{},{:.3f},\"{}\"\n", r.name, r.tolerance, exit_word(r), fault_of(r).what, r.worst.joint, r.worst.error, r.doubt, r.worst.estimate, r.joints,
                         r.honest_joints, r.passes, r.steps, r.seconds, r.message.substr(0, 200));
    list_.flush();
  }

  const BatteryOptions& options_;
  BatteryLimits limits_;
  std::map<std::pair<std::string, double>, BatteryTally> tallies_;
  BatteryTally sum_;
  std::vector<std::pair<Fault, MeasuredRun>> faults_;
  std::ofstream list_;  // of all runs
  std::vector<Jump> jumps_;
  std::vector<std::string> refused_;
};

}  // namespace

nlohmann::ordered_json run_battery(const BatteryOptions& options) {
  Battery battery(options);
  const pintle::Stopwatch clock;
  for (int i = 0; i < options.count && (options.time <= 0 || clock.seconds() < options.time); ++i) battery.measure(options.first + i);
  return battery.finish();
}

}  // namespace pintle::bench
