// The comparison of the integration methods as text.
#include <fmt/format.h>

#include <cmath>

#include "results/studies/solvers_report.h"
#include "results/text_table.h"

namespace pintle {
namespace {

using Align = TextTable::Align;

std::string known(double x, const char* format) { return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "-"; }

std::string truth_text(const SolverStudy& study) {
  const SolverTruth& t = study.truth;
  std::string text = fmt::format("Reference: {}, tolerance {:g}; its joint forces are accurate to about {:.1e} of their peaks by its own estimate ({:.3g} s)\n",
                                 t.method, t.tolerance, t.error_estimate, t.seconds);
  if (!t.message.empty()) text += fmt::format("  {}\n", t.message);
  return text;
}

std::string table_text(const SolverStudy& study, const std::string& bold, const std::string& plain) {
  TextTable table;
  table.add_column("method", Align::kLeft);
  for (const char* head : {"tolerance", "steps", "evaluations"}) table.add_column(head, Align::kNumber);
  table.add_column("time", Align::kNumber, "ms");
  table.add_column("force error", Align::kNumber, "-");
  table.add_column("at", Align::kLeft);
  table.add_column("position error", Align::kNumber, "m");
  table.add_column("vibration", Align::kNumber, "N");
  table.add_column("of peak", Align::kNumber, "-");
  table.add_column("", Align::kLeft);
  for (const SolverRun& run : study.runs)
    table.add_row({run.method, fmt::format("{:.0e}", run.tolerance), fmt::format("{:.0f}", run.steps), fmt::format("{:.0f}", run.evaluations),
                   fmt::format("{:.2f}", 1e3 * run.seconds), known(run.force_error, "{:.1e}"), run.worst_joint, known(run.position_error, "{:.1e}"),
                   known(run.vibration, "{:.1e}"), known(run.vibration_of_peak, "{:.1e}"),
                   run.end == SolverEnd::kCompleted ? "" : fmt::format("{} at t = {:.4g} s", to_text(run.end), run.t_end)});
  return table.text(bold, plain);
}

std::string order_text(const SolverStudy& study, const std::string& bold, const std::string& plain) {
  TextTable table;
  table.add_column("method", Align::kLeft);
  table.add_column("order observed", Align::kNumber);
  table.add_column("from runs", Align::kNumber);
  for (const SolverOrder& order : study.orders)
    table.add_row({order.method, known(order.order, "{:.1f}"), fmt::format("{}", order.runs)});
  return table.empty() ? "" : "\nHow the force error falls: error ~ 1 / steps^order\n" + table.text(bold, plain);
}

std::string legend_text(const SolverStudy& study) {
  return fmt::format(
      "\n  force error: largest over joints and output times, relative to the joint's peak force (or couple)\n"
      "  vibration: parasitic; peak to peak of a joint force's error in the last half of the run, less its running mean\n"
      "             over {:.3g} s, in N and relative to the joint's peak force\n"
      "  time: one integration with its {:.0f} output times; radau and dopri5 control the error of the joint\n"
      "        forces, the others that of positions and velocities, as general integrators do; pintle run repeats\n"
      "        the integration until the forces meet the tolerance\n",
      study.window, std::floor(study.duration / study.output_step * (1 + 1e-9)));
}

}  // namespace

std::string to_text(SolverEnd end) {
  switch (end) {
    case SolverEnd::kCompleted:
      return "completed";
    case SolverEnd::kOutOfTime:
      return "stopped";
    case SolverEnd::kFailed:
      return "failed";
    case SolverEnd::kInterrupted:
      return "interrupted";
  }
  return "";
}

std::string solvers_text(const SolverStudy& study, const std::string& title, bool colour) {
  const std::string bold = colour ? "\x1b[1m" : "", plain = colour ? "\x1b[0m" : "";
  std::string text = fmt::format("{}{}{}\n{:.6g} s of model time, joint forces every {:.3g} s\n", bold, title, plain, study.duration, study.output_step);
  text += truth_text(study);
  if (!study.runs.empty()) text += "\n" + table_text(study, bold, plain) + order_text(study, bold, plain) + legend_text(study);
  for (const SolverRun& run : study.runs)
    if (run.end == SolverEnd::kFailed) text += fmt::format("\n  {} at tolerance {:g}: {}", run.method, run.tolerance, run.message);
  for (const std::string& note : study.notes) text += "\n  " + note;
  if (text.back() != '\n') text += "\n";
  return text;
}

}  // namespace pintle
