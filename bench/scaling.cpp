#include "bench/scaling.h"

#include <cmath>
#include <memory>
#include <utility>

#include "bench/pintle_methods.h"
#include "bench/stopwatch.h"
#include "tests/large_models.h"

namespace pintle::bench {

double Scaling::exponent() const {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(rows.size());
  for (const Row& row : rows) {
    const double x = std::log(row.loops), y = std::log(row.seconds);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

ResultTable Scaling::table() const {
  ResultTable table("Time against size: N four-bars", {{"N", "loops"},
                                                       {"bodies", "bodies"},
                                                       {"steps", "steps"},
                                                       {"Newton", "newton_iterations_per_step"},
                                                       {"ms", "milliseconds"},
                                                       {"spread", "spread"},
                                                       {"us per body and step", "microseconds_per_body_and_step"},
                                                       {"start, ms", "start_milliseconds"}});
  for (const Row& row : rows)
    table.add_row({count(row.loops), count(row.bodies), count(row.steps), number(row.iterations / row.steps, "{:.1f}"),
                   number(1e3 * row.seconds, "{:.2f}"), number(row.spread, "{:.2f}"),
                   number(1e6 * row.per_body_and_step(), "{:.2f}"), number(1e3 * row.start_seconds, "{:.1f}")});
  return table;
}

namespace {

constexpr double kTurn = 0.3;  // time for one size in a round [s], unless a single run takes longer

struct Subject {
  explicit Subject(Model model) : ready(std::move(model)), problem(ready.problem(1)) {}
  ReadyModel ready;
  Problem problem;
  Times times;
};

}  // namespace

Scaling measure_scaling(const std::vector<int>& loops, int rounds, double duration, double tolerance) {
  Scaling out;
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const int n : loops) {
    Model model = sample::ladder_model(n);
    model.simulate.duration = duration;
    const Stopwatch watch;
    subjects.push_back(std::make_unique<Subject>(std::move(model)));
    Scaling::Row& row = out.rows.emplace_back();
    row.loops = n;
    row.bodies = subjects.back()->ready.system.n_bodies();
    row.start_seconds = watch.seconds();
  }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < loops.size(); ++i) {
      Subject& subject = *subjects[i];
      const Stopwatch turn;
      do {
        const PintleRun run = run_radau(subject.problem, 3, tolerance);
        subject.times.add(run.seconds);
        out.rows[i].steps = static_cast<double>(run.counters.steps);
        out.rows[i].iterations = static_cast<double>(run.counters.newton_iterations);
      } while (turn.seconds() < kTurn);
    }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    out.rows[i].seconds = subjects[i]->times.median();
    out.rows[i].spread = subjects[i]->times.spread();
  }
  return out;
}

}  // namespace pintle::bench
