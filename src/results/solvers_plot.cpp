// The comparison of the integration methods as a picture.
#include <fmt/format.h>

#include "results/solvers_report.h"

namespace pintle {
namespace {

Panel panel(const SolverStudy& study, const char* quantity, const char* unit, double (*cost)(const SolverRun&)) {
  Panel out;
  out.quantity = "Joint-force error, relative to the joint's peak";
  out.x_quantity = quantity;
  out.x_unit = unit;
  out.log_x = out.log_y = true;
  for (const SolverRun& run : study.runs) {
    if (out.curves.empty() || out.curves.back().label != run.method) {
      Curve curve{run.method, "", {}};
      curve.dots = curve.joined = true;
      out.curves.push_back(std::move(curve));
    }
    out.curves.back().x.push_back(cost(run));
    out.curves.back().y.push_back(run.force_error);
  }
  return out;
}

}  // namespace

Plot solvers_plot(const SolverStudy& study, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.subtitle = fmt::format("Reference: {}, tolerance {:g}, error about {:.0e}", study.truth.method, study.truth.tolerance, study.truth.error_estimate);
  plot.panels = {panel(study, "Wall time", "ms", [](const SolverRun& run) { return 1e3 * run.seconds; }),
                 panel(study, "Evaluations", "", [](const SolverRun& run) { return run.evaluations; })};
  return plot;
}

}  // namespace pintle
