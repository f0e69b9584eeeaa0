#include "bench/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/groups.h"

namespace pintle::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

class Judge {
 public:
  explicit Judge(const std::map<std::string, const WorkPrecision*>& works) : works_(works) {}

  void within(const std::string& problem, const std::string& what, Measure measure, double error, double wanted) {
    if (!works_.contains(problem)) return;
    const double found = time_of(problem, group::kPintle, measure, error);
    add(what, fmt::format("<= {:g} ms", 1e3 * wanted), found < kNone ? fmt::format("{:.2f} ms", 1e3 * found) : "not reached", found <= wanted);
  }

  // A rival that does not reach the error takes at least as long as the longest of its runs.
  void faster(const std::string& problem, const std::string& what, const std::string& rival, Measure measure, double error, double wanted) {
    if (!works_.contains(problem) || !has(problem, rival)) return;
    const double ours = time_of(problem, group::kPintle, measure, error), theirs = time_of(problem, rival, measure, error);
    const double ratio = (theirs < kNone ? theirs : least_time_of(problem, rival)) / ours;
    const char* const more = theirs < kNone ? "" : "> ";
    const bool known = ours < kNone && (theirs < kNone || ratio >= wanted);
    add(what, fmt::format(">= {:g} times", wanted), ours < kNone ? fmt::format("{}{:.3g} times", more, ratio) : "not reached", known && ratio >= wanted);
  }

  void add(const std::string& what, const std::string& wanted, const std::string& found, bool passes) {
    table_.add_row({text(what), text(wanted), text(found), text(passes ? "pass" : "not met")});
  }
  ResultTable table() const { return table_; }

 private:
  double time_of(const std::string& problem, const std::string& group, Measure measure, double error) const {
    const WorkPrecision& work = *works_.at(problem);
    const int best = work.best_for(group, measure, error);
    return best < 0 ? kNone : work.time_for(static_cast<std::size_t>(best), measure, error);
  }
  double least_time_of(const std::string& problem, const std::string& group) const {
    const WorkPrecision& work = *works_.at(problem);
    std::map<std::size_t, double> longest;
    for (const Rung& rung : work.rungs())
      if (work.contestant(rung.contestant).group == group && !rung.skipped)
        longest[rung.contestant] = std::max(longest[rung.contestant], rung.times.median());
    double least = kNone;
    for (const auto& [contestant, seconds] : longest) least = std::min(least, seconds);
    return least;
  }
  bool has(const std::string& problem, const std::string& group) const {
    const WorkPrecision& work = *works_.at(problem);
    for (std::size_t i = 0; i < work.size(); ++i)
      if (work.contestant(i).group == group) return true;
    return false;
  }

  const std::map<std::string, const WorkPrecision*>& works_;
  ResultTable table_{"Targets", {{"what", "what", true}, {"target", "wanted", true}, {"measured", "measured", true}, {"", "verdict", true}}};
};

void judge_a02(Judge& judge) {
  struct Case {
    int n;
    double error, wanted;
  };
  for (const auto& [n, error, wanted] : {Case{1, 1e-3, 1e-3}, Case{40, 1e-3, 60e-3}, Case{40, 1e-4, 150e-3}, Case{400, 1e-3, 0.6}}) {
    const std::string problem = fmt::format("a02_{}", n), what = fmt::format("A02, N = {}, end point to {:.0e} m", n, error);
    judge.within(problem, what, Measure::kEnd, error, wanted);
    judge.faster(problem, what + ": faster than dopri5 on the same equations", group::kExplicit, Measure::kEnd, error, 10);
    judge.faster(problem, what + ": faster than MuJoCo with ideal joints", group::kMujoco, Measure::kEnd, error, 1);
  }
}

}  // namespace

ResultTable judge_targets(const std::map<std::string, const WorkPrecision*>& works, const Scaling* scaling, double turns_per_second) {
  Judge judge(works);
  judge_a02(judge);
  judge.within("pendulum", "Pendulum, 10 s, position to 1e-5 m", Measure::kPlace, 1e-5, 1e-3);
  judge.within("pendulum", "Pendulum, 10 s, position to 1e-8 m", Measure::kPlace, 1e-8, 5e-3);
  judge.within("andrews", "Andrews' squeezer, position to 1e-5 m", Measure::kPlace, 1e-5, 3e-3);
  for (const double error : {1e-3, 1e-4, 1e-5})
    judge.faster("four_bar", fmt::format("Four-bar, forces to {:.0e}: faster than the best SUNDIALS method", error), group::kSundials, Measure::kForce, error, 20);
  if (scaling) {
    for (const Scaling::Row& row : scaling->rows)
      if (row.loops == 400)
        judge.add("Time per body and step, N = 400", "<= 0.6 us", fmt::format("{:.2f} us", 1e6 * row.per_body_and_step()), row.per_body_and_step() <= 0.6e-6);
    judge.add(fmt::format("Exponent of time over N, from {} to {}", scaling->rows.front().loops, scaling->rows.back().loops), "<= 1.05",
              fmt::format("{:.3f}", scaling->exponent()), scaling->exponent() <= 1.05);
  }
  if (turns_per_second > 0)
    judge.add("Four-bar turns per second and core, tolerance 1e-4", ">= 20000", fmt::format("{:.0f}", turns_per_second), turns_per_second >= 20000);
  return judge.table();
}

}  // namespace pintle::bench
