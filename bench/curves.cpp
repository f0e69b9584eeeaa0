// Work and precision of every method on every mechanism of the curves.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "bench/commands.h"
#include "bench/curve_case.h"

namespace pintle::bench {

nlohmann::ordered_json measure_curves(const CurveOptions& options) {
  nlohmann::ordered_json out;
  CaseOptions with;
  with.quick = options.quick;
  with.cap = options.cap;
  for (const CurveProblem& problem : curve_problems()) {
    if (!options.problems.empty() && std::find(options.problems.begin(), options.problems.end(), problem.name) == options.problems.end()) continue;
    fmt::print("\n{}\n", problem.title);
    std::fflush(stdout);
    const CurveCase one(problem, with);
    for (const std::string& equations : {kCompliant, kIdeal}) {
      const Truth& truth = one.truth(equations);
      if (truth.samples) fmt::print("  {} joints: {}; {:.1e} of forces, {:.1e} m from the run before it\n", equations, truth.method, truth.force_doubt, truth.place_doubt);
    }
    WorkPrecision work(one.contestants());
    work.measure({options.rounds, 0.3, options.cap / 4});
    const ResultTable table = work.table(problem.title);
    table.print();
    out[problem.name] = table.json();
  }
  return out;
}

}  // namespace pintle::bench
