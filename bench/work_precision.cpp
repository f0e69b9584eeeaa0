#include "bench/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace pintle::bench {
namespace {

// A program that refuses the problem counts as not having completed it.
MethodRun run_or_refuse(const Contestant& contestant, double setting) {
  try {
    return contestant.run(setting);
  } catch (const std::exception& error) {
    fmt::print("  {}: {}\n", contestant.name, error.what());
    return {false, 0, 0, 0, *contestant.truth};
  }
}

}  // namespace

double Rung::error(Measure measure) const {
  return measure == Measure::kForce ? force_error : measure == Measure::kPlace ? place_error : end_error;
}

void WorkPrecision::measure(const Effort& effort) {
  for (std::size_t c = 0; c < contestants_.size(); ++c)
    for (const double tolerance : contestants_[c].ladder) {
      Rung rung;
      rung.contestant = c;
      rung.tolerance = tolerance;
      rungs_.push_back(rung);
    }
  for (Rung& rung : rungs_) first_look(rung, effort);
  for (int round = 1; round <= effort.rounds; ++round)
    for (Rung& rung : rungs_) {
      if (!rung.completed || rung.times.median() > effort.repeat_below) continue;
      const MethodRun run = contestants_[rung.contestant].run(rung.tolerance);
      if (round == 1) rung.times = {};  // the first look warmed up the caches
      rung.times.add(run.seconds);
    }
}

void WorkPrecision::first_look(Rung& rung, const Effort& effort) {
  const Contestant& contestant = contestants_[rung.contestant];
  for (const Rung& coarser : rungs_)
    if (&coarser < &rung && coarser.contestant == rung.contestant && (coarser.skipped || coarser.times.median() > effort.hopeless))
      rung.skipped = true;
  if (rung.skipped) return;
  const MethodRun run = run_or_refuse(contestant, rung.tolerance);
  rung.times.add(run.seconds);
  rung.completed = run.completed;
  rung.steps = run.steps;
  rung.evaluations = run.evaluations;
  const double none = std::numeric_limits<double>::infinity();
  rung.force_error = run.completed ? run.samples.error(*contestant.truth) : none;
  rung.place_error = run.completed ? run.samples.place_error(*contestant.truth) : none;
  rung.end_error = run.completed ? run.samples.end_error(*contestant.truth) : none;
}

ResultTable WorkPrecision::table(const std::string& title) const {
  ResultTable table(title, {{"method", "method", true},
                            {"joints", "joints", true},
                            {"setting", "setting"},
                            {"steps", "steps"},
                            {"evaluations", "evaluations"},
                            {"force error", "force_error"},
                            {"place [m]", "place_error"},
                            {"at end [m]", "end_error"},
                            {"ms", "milliseconds"},
                            {"+- %", "spread_percent"}});
  for (const Rung& rung : rungs_) {
    if (rung.skipped) continue;
    const Contestant& c = contestants_[rung.contestant];
    table.add_row({text(c.name), text(c.solves), number(rung.tolerance, "{:.0e}"), count(rung.steps), count(rung.evaluations),
                   number(rung.force_error, "{:.1e}"), number(rung.place_error, "{:.1e}"), number(rung.end_error, "{:.1e}"),
                   number(1e3 * rung.times.median(), "{:.3f}"), number(100 * rung.times.spread(), "{:.0f}")});
  }
  return table;
}

double WorkPrecision::time_for(std::size_t contestant, Measure measure, double error) const {
  std::vector<std::pair<double, double>> front;  // time, error: each more accurate than all cheaper ones
  for (const Rung& rung : rungs_)
    if (rung.contestant == contestant && rung.completed) front.emplace_back(rung.times.median(), rung.error(measure));
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

int WorkPrecision::best_for(const std::string& group, Measure measure, double error) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < contestants_.size(); ++c) {
    if (contestants_[c].group != group && contestants_[c].name != group) continue;
    if (const double t = time_for(c, measure, error); t < least) {
      least = t;
      best = static_cast<int>(c);
    }
  }
  return best;
}

}  // namespace pintle::bench
