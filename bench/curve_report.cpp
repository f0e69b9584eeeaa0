#include "bench/curve_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/groups.h"
#include "results/plots/svg_plot.h"

namespace pintle::bench {
namespace {

constexpr double kUseless = 1;  // larger errors are left out of pictures: relative to the peak force, or in metres

bool takes_part(const WorkPrecision& work, const std::string& group, Measure measure) {
  return std::any_of(work.rungs().begin(), work.rungs().end(), [&](const Rung& rung) {
    return work.contestant(rung.contestant).group == group && rung.completed && std::isfinite(rung.error(measure));
  });
}

// The group's runs that are not beaten by a cheaper one.
Curve front_of(const WorkPrecision& work, const std::string& group, Measure measure) {
  std::vector<std::pair<double, double>> points;  // seconds, error
  for (const Rung& rung : work.rungs())
    if (work.contestant(rung.contestant).group == group && rung.completed && rung.error(measure) < kUseless && rung.error(measure) > 0)
      points.emplace_back(rung.times.median(), rung.error(measure));
  std::sort(points.begin(), points.end());
  Curve curve{group, "", {}};
  curve.dots = curve.joined = true;
  for (const auto& [seconds, error] : points) {
    if (!curve.y.empty() && error >= curve.y.back()) continue;
    curve.x.push_back(1e3 * seconds);
    curve.y.push_back(error);
  }
  return curve;
}

Panel panel(const WorkPrecision& work, Measure measure, const char* quantity, const char* unit) {
  Panel out;
  out.quantity = quantity;
  out.unit = unit;
  out.x_quantity = "Processor time";
  out.x_unit = "ms";
  out.log_x = out.log_y = true;
  for (std::size_t i = 0; i < group::kAll.size(); ++i) {
    Curve curve = front_of(work, group::kAll[i], measure);
    if (curve.x.empty()) continue;
    curve.style = group::kStyle[i];
    out.curves.push_back(std::move(curve));
  }
  return out;
}

}  // namespace

ResultTable price_table(const WorkPrecision& work, Measure measure, const std::string& title) {
  std::vector<ResultTable::Column> columns{{"error", "error"}};
  std::vector<std::string> groups;
  for (const std::string& group : group::kAll)
    if (takes_part(work, group, measure)) {
      groups.push_back(group);
      columns.push_back({group, group});
    }
  ResultTable table(title, columns);
  const bool force = measure == Measure::kForce;
  for (const double error : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    if (force && error < 1e-6) continue;
    std::vector<Cell> row{number(error, "{:.0e}")};
    for (const std::string& group : groups) {
      const int best = work.best_for(group, measure, error);
      const double ms = best < 0 ? NAN : 1e3 * work.time_for(static_cast<std::size_t>(best), measure, error);
      row.push_back(number(ms, ms < 9.95 ? "{:.2f}" : ms < 99.5 ? "{:.1f}" : "{:.0f}"));
    }
    table.add_row(std::move(row));
  }
  return table;
}

std::string picture(const WorkPrecision& work, const std::string& title, const std::string& subtitle) {
  Plot plot;
  plot.title = title;
  plot.subtitle = subtitle;
  plot.panels = {panel(work, Measure::kForce, "Joint-force error, relative to the joint's peak", ""), panel(work, Measure::kPlace, "Position error of the point", "m")};
  std::erase_if(plot.panels, [](const Panel& p) { return p.curves.empty(); });
  return to_svg(plot);
}

std::string curves_page(const std::vector<ProblemReport>& problems, const ResultTable& targets, const nlohmann::ordered_json& machine) {
  std::string page =
      "# Work and precision\n\n"
      "Written by `pintle-bench curves --write docs/benchmarks`; [Benchmarks](../benchmarks.md#curves) explains what is measured and how to read it.\n"
      "Every curve is the best of a group of methods: no cheaper run of the group has a smaller error. Times are medians, in milliseconds of\n"
      "processor time; \"-\" means that no run of the group reached this error within the time limit.\n\n";
  page += "| measured on | |\n| --- | --- |\n";
  for (const auto& [key, value] : machine.items()) page += fmt::format("| {} | {} |\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  page += "\n## Targets\n\n" + targets.markdown();
  for (const ProblemReport& report : problems) {
    page += fmt::format("\n## {}\n\n{}{}\n![{}]({}.svg)\n", report.problem.title, report.problem.remark.empty() ? "" : report.problem.remark + "\n\n", report.truths,
                        report.problem.title, report.problem.name);
    for (const ResultTable& table : report.tables) page += fmt::format("\n{}\n\n{}", table.title(), table.markdown());
  }
  return page;
}

}  // namespace pintle::bench
