// Does the work depend on the stiffness of the joints? One turn of the four-bar from k = 1e6 to 1e12 N/m.
#include <fmt/format.h>

#include "bench/commands.h"
#include "bench/pintle_methods.h"
#include "bench/result_table.h"
#include "bench/stopwatch.h"

namespace pintle::bench {
namespace {

constexpr int kOutputs = 200;
constexpr double kReferenceTolerance = 1e-10;

}  // namespace

nlohmann::ordered_json study_stiffness(const StiffnessOptions& options) {
  ResultTable table(
      fmt::format("Four-bar, one turn at tolerance {:.0e}: both integrations of a run", options.tolerance),
      {{"damping [N*s/m]", "damping"},
       {"stiffness [N/m]", "stiffness"},
       {"pilot steps", "pilot_steps"},
       {"steps", "steps"},
       {"rejected", "rejected"},
       {"Newton iterations", "newton_iterations"},
       {"ms", "milliseconds"},
       {"force error", "force_error"},
       {"/tolerance", "error_over_tolerance"}});
  for (const double damping : options.damping)
    for (const double stiffness : options.stiffness) {
      const ReadyModel ready(collection_model("four_bar", {fmt::format("defaults.joint.stiffness={}", stiffness),
                                                           fmt::format("defaults.joint.damping={}", damping)}));
      const Problem problem = ready.problem(kOutputs);
      const PintleRun reference = run_radau(problem, 5, kReferenceTolerance);
      Times times;
      for (int i = 0; i < options.repetitions; ++i) {
        const RunPasses once = run_passes(problem, options.tolerance);
        times.add(once.pilot.seconds + once.reported.seconds);
      }
      const RunPasses passes = run_passes(problem, options.tolerance);
      const Counters& c = passes.reported.counters;
      const double error = passes.reported.samples.error(reference.samples);
      table.add_row({number(damping, "{:.3g}"), number(stiffness, "{:.0e}"),
                     count(static_cast<double>(passes.pilot.counters.steps)), count(static_cast<double>(c.steps)),
                     count(static_cast<double>(c.rejected)), count(static_cast<double>(c.newton_iterations)),
                     number(1e3 * times.median(), "{:.3f}"), number(error, "{:.1e}"),
                     number(error / options.tolerance, "{:.2g}")});
    }
  table.print();
  return table.json();
}

}  // namespace pintle::bench
