// Work-precision curves of every method on every mechanism: tables, pictures, a page.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench/commands.h"
#include "bench/curve_case.h"
#include "bench/curve_report.h"
#include "bench/sweep_rate.h"

namespace pintle::bench {
namespace {

const std::vector<std::string> kQuick{"pendulum", "four_bar", "a02_1", "a02_40", "andrews"};
constexpr double kQuickCap = 2;
constexpr double kSmallShare = 0.3;  // fraction of the cap, for runs of small mechanisms
constexpr int kQuickRounds = 2;
constexpr int kTurns = 1000;

std::vector<CurveProblem> chosen(const std::vector<std::string>& names) {
  std::vector<CurveProblem> list = curve_problems();
  for (const std::string& name : names)
    if (std::none_of(list.begin(), list.end(), [&](const CurveProblem& p) { return p.name == name; })) throw std::invalid_argument("there is no problem " + name);
  std::erase_if(list, [&](const CurveProblem& p) { return !names.empty() && std::find(names.begin(), names.end(), p.name) == names.end(); });
  return list;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

class Study {
 public:
  explicit Study(const CurveOptions& options) : options_(options) {
    if (!options.quick) return;
    options_.cap = std::min(options.cap, kQuickCap);
    options_.rounds = std::min(options.rounds, kQuickRounds);
  }

  nlohmann::ordered_json run() {
    nlohmann::ordered_json machine = describe_machine();
    machine["kind of run"] = options_.quick ? "--quick: some problems, small caps" : options_.problems.empty() ? "full" : "chosen problems";
    for (const auto& [key, value] : machine.items()) fmt::print("{}: {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    fmt::print("A run longer than {:g} s ({:g} s for large mechanisms) is stopped, and finer runs of its method are skipped.\n",
               kSmallShare * options_.cap, options_.cap);
    out_["machine"] = machine;
    for (const CurveProblem& problem : chosen(options_.problems.empty() && options_.quick ? kQuick : options_.problems)) measure(problem);
    const bool all = options_.problems.empty();
    if (all) scaling_ = measure_scaling(options_.quick ? std::vector{40, 400} : std::vector{40, 400, 4000, 40000}, options_.quick ? 2 : 7);
    if (all) keep("scaling", scaling_.table());
    std::map<std::string, const WorkPrecision*> works;
    for (const auto& [name, work] : works_) works[name] = work.get();
    const ResultTable targets = judge_targets(works, all ? &scaling_ : nullptr, all ? turns_per_second(kTurns) : 0);
    keep("targets", targets);
    if (!options_.folder.empty()) write_text(std::filesystem::path(options_.folder) / "README.md", curves_page(reports_, targets, machine));
    return std::move(out_);
  }

 private:
  void keep(const std::string& key, const ResultTable& table) {
    table.print();
    out_[key] = table.json();
  }

  void measure(const CurveProblem& problem) {
    fmt::print("\n{}\n", problem.title);
    std::fflush(stdout);
    const double cap = (problem.small ? kSmallShare : 1) * options_.cap;
    const CurveCase one(problem, {options_.quick, cap});
    fmt::print("{}", one.truths());
    auto work = std::make_unique<WorkPrecision>(one.contestants());
    work->measure({options_.rounds, 0.1, cap / 2});
    const ResultTable runs = work->table("Every run");
    if (options_.details) runs.print();
    ProblemReport report{problem, one.truths(), {}};
    nlohmann::ordered_json& json = out_["problems"][problem.name];
    json["runs"] = runs.json();
    for (const auto& [measure, key, title] : {std::tuple{Measure::kForce, "forces", "Milliseconds for a joint-force error, relative to the peaks"},
                                              std::tuple{Measure::kPlace, "places", "Milliseconds for a position error of the point [m]"},
                                              std::tuple{Measure::kEnd, "end", "Milliseconds for a position error of the point at the end [m]"}}) {
      if (measure == Measure::kEnd && problem.loops == 0) continue;
      const ResultTable prices = price_table(*work, measure, title);
      if (prices.n_columns() < 2) continue;
      prices.print();
      json[key] = prices.json();
      report.tables.push_back(prices);
    }
    if (!options_.folder.empty()) {
      std::filesystem::create_directories(options_.folder);
      write_text(std::filesystem::path(options_.folder) / (problem.name + ".svg"),
                 picture(*work, problem.title, "Best of each group of methods; compliant joints unless it says ideal"));
    }
    reports_.push_back(std::move(report));
    works_[problem.name] = std::move(work);
  }

  CurveOptions options_;
  nlohmann::ordered_json out_;
  std::map<std::string, std::unique_ptr<WorkPrecision>> works_;
  std::vector<ProblemReport> reports_;
  Scaling scaling_;
};

}  // namespace

void store_truths(const std::vector<std::string>& problems, double tolerance) {
  for (const CurveProblem& problem : chosen(problems)) store_truth(problem, tolerance);
}

nlohmann::ordered_json measure_curves(const CurveOptions& options) { return Study(options).run(); }

}  // namespace pintle::bench
