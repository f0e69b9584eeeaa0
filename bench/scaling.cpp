#include "bench/scaling.h"

#include <cmath>
#include <memory>

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
                                                       {"ms", "milliseconds"},
                                                       {"us per body and step", "microseconds_per_body_and_step"},
                                                       {"start, ms", "start_milliseconds"}});
  for (const Row& row : rows)
    table.add_row({count(row.loops), count(row.bodies), count(row.steps), number(1e3 * row.seconds, "{:.2f}"),
                   number(1e6 * row.per_body_and_step(), "{:.2f}"), number(1e3 * row.start_seconds, "{:.1f}")});
  return table;
}

Scaling measure_scaling(const std::vector<int>& loops, int rounds, double duration, double tolerance) {
  Scaling out;
  for (const int n : loops) {
    Model model = sample::ladder_model(n);
    model.simulate.duration = duration;
    const Stopwatch watch;
    const ReadyModel ready(model);
    Scaling::Row row{n, ready.system.n_bodies(), 0, 0, watch.seconds()};
    const Problem problem = ready.problem(1);
    Times times;
    for (int i = 0; i < rounds; ++i) {
      const PintleRun run = run_radau(problem, 3, tolerance);
      times.add(run.seconds);
      row.steps = static_cast<double>(run.counters.steps);
    }
    row.seconds = times.median();
    out.rows.push_back(row);
  }
  return out;
}

}  // namespace pintle::bench
