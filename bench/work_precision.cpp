#include "bench/work_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle::bench {
namespace {

constexpr double kTooSlow = 2;  // seconds: looked at once, not repeated

}  // namespace

void WorkPrecision::measure(int rounds, const ForceSamples& reference) {
  for (std::size_t c = 0; c < contestants_.size(); ++c)
    for (const double tolerance : contestants_[c].ladder) rungs_.push_back({c, tolerance, false, 0, 0, 0, {}});
  for (int round = 0; round <= rounds; ++round)
    for (Rung& rung : rungs_) {
      if (round > 0 && (!rung.completed || rung.times.median() > kTooSlow)) continue;
      const MethodRun run = contestants_[rung.contestant].run(rung.tolerance);
      if (round == 1) rung.times = {};  // the first round was for the caches
      rung.times.add(run.seconds);
      if (round > 0) continue;
      rung.completed = run.completed;
      rung.steps = run.steps;
      rung.evaluations = run.evaluations;
      rung.error = run.completed ? run.samples.error(reference) : std::numeric_limits<double>::infinity();
    }
}

ResultTable WorkPrecision::table() const {
  ResultTable table("Work and precision: largest joint-force error over the peak, median time",
                    {{"method", "method", true},
                     {"tolerance", "tolerance"},
                     {"steps", "steps"},
                     {"evaluations", "evaluations"},
                     {"force error", "force_error"},
                     {"ms", "milliseconds"},
                     {"+- %", "spread_percent"}});
  for (const Rung& rung : rungs_)
    table.add_row({text(contestants_[rung.contestant].name), number(rung.tolerance, "{:.0e}"), count(rung.steps),
                   count(rung.evaluations), number(rung.error, "{:.1e}"), number(1e3 * rung.times.median(), "{:.3f}"),
                   number(100 * rung.times.spread(), "{:.0f}")});
  return table;
}

double WorkPrecision::time_for(std::size_t contestant, double error) const {
  std::vector<std::pair<double, double>> front;  // time, error: each better than all cheaper ones
  for (const Rung& rung : rungs_)
    if (rung.contestant == contestant && rung.completed) front.emplace_back(rung.times.median(), rung.error);
  std::sort(front.begin(), front.end());
  double best = std::numeric_limits<double>::infinity();
  std::erase_if(front, [&best](const auto& point) {
    if (!(point.second < best)) return true;
    best = point.second;
    return false;
  });
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (front[i].second > error) continue;
    if (i == 0) return front[0].first;
    const auto& [t0, e0] = front[i - 1];
    const auto& [t1, e1] = front[i];
    const double share = std::log(error / e0) / std::log(e1 / e0);
    return t0 * std::pow(t1 / t0, share);
  }
  return std::numeric_limits<double>::infinity();
}

int WorkPrecision::best_for(const std::string& group, double error) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < contestants_.size(); ++c) {
    if (contestants_[c].group != group && contestants_[c].name != group) continue;
    if (const double t = time_for(c, error); t < least) {
      least = t;
      best = static_cast<int>(c);
    }
  }
  return best;
}

}  // namespace pintle::bench
