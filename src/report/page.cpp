// Assembles the page of a report.
#include <fmt/format.h>

#include <string_view>

#include "pintle/report.h"
#include "report/page_data.h"
#include "report/page_tables.h"
#include "report/still.h"
#include "results/force_quality.h"
#include "results/plots/markup.h"

namespace pintle {

// src/report/page
extern const char* const kPageStyle;
extern const char* const kPageValues;
extern const char* const kPageClock;
extern const char* const kPageStage;
extern const char* const kPageChart;
extern const char* const kPagePolar;
extern const char* const kPageMain;

namespace {

std::string title_of(const Model& model, const RunRecord& run) {
  if (!model.name.empty()) return model.name;
  return run.stamp.model_path.empty() ? "A mechanism" : run.stamp.model_path;
}

std::string header(const Model& model, const RunRecord& run) {
  static constexpr std::string_view kKinds[] = {"good", "doubtful", "bad"};
  static constexpr std::string_view kMarks[] = {"✓", "!", "✕"};
  const Verdict verdict = verdict_on(run.trajectory);
  std::string html = fmt::format("<header>\n<p class=\"made\">Pintle report</p>\n<h1>{}</h1>\n<p class=\"facts\">{}</p>\n", escaped_markup(title_of(model, run)),
                                 facts_line(model, run.trajectory));
  if (!model.description.empty()) html += "<p class=\"about\">" + escaped_markup(model.description) + "</p>\n";
  return html + fmt::format("<p class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> {}</p>\n</header>\n", kKinds[verdict.kind], kMarks[verdict.kind],
                            escaped_markup(verdict.text));
}

/// A still at the peak over all joints, for print and for browsers without scripts.
std::string still(const Scene& scene, const Trajectory& trajectory) {
  const LoadSummary* joint = largest_joint(trajectory);
  const double t = joint ? joint->peak_time : trajectory.at(0, 0);
  StillOptions options;
  options.most_height = 620;
  options.whole_arrows = true;
  std::string svg = still_svg(scene, instant_at(scene, trajectory, t), options);
  constexpr std::string_view kNamespace = " xmlns=\"http://www.w3.org/2000/svg\"";  // HTML does not need it
  if (const std::size_t at = svg.find(kNamespace); at != std::string::npos) svg.erase(at, kNamespace.size());
  return fmt::format("<figure class=\"still\">{}<figcaption>{}</figcaption></figure>\n", svg,
                     joint ? fmt::format("At the largest joint force, {:.5g} N at {}, t = {:.5g} s. Arrows are the forces on the second body of each joint.",
                                         joint->peak, escaped_markup(joint->name), t)
                           : "At the start.");
}

constexpr std::string_view kStage = R"html(<div id="stage" hidden>
<canvas id="mechanism" tabindex="0" role="img" aria-label="The moving mechanism"></canvas>
<div class="bar" role="group" aria-label="Playback">
<button id="play" class="main" aria-pressed="false" title="Space">Play</button>
<button id="back" title="Left arrow" aria-label="One row back">◂</button>
<button id="on" title="Right arrow" aria-label="One row forward">▸</button>
<input id="time" type="range" min="0" value="0" step="1" aria-label="Time">
<output id="clock" for="time"></output>
<label>speed <select id="speed"></select></label>
</div>
<div class="bar" role="group" aria-label="Display">
<label><input type="checkbox" id="forces" checked> forces</label>
<label><input type="checkbox" id="names"> names</label>
<label><input type="checkbox" id="masses"> centres of mass</label>
<label>trace <select id="trace"></select></label>
<label>arrows <input id="arrow-size" type="range" min="-1" max="1" value="0" step="0.1" aria-label="Size of the force arrows"></label>
<button id="fit" title="Wheel: zoom. Drag: move. Double click: fit." hidden>Fit</button>
<span class="hint">space: play · ← →: step · wheel: zoom</span>
</div>
</div>
)html";

std::string motion(const Scene& scene, const RunRecord& run) {
  const Trajectory& trajectory = run.trajectory;
  std::string html = "<section id=\"motion\" aria-labelledby=\"motion-title\">\n<h2 id=\"motion-title\">Motion</h2>\n";
  if (trajectory.n_rows() == 0) return html + "<p>The run has no rows to show.</p>\n</section>\n";
  if (scene.n_unseen == scene.bodies.size()) {
    html += "<p>The run did not record any body, so it cannot be drawn. <code>record = [\"all\"]</code> in "
            "<code>[simulate]</code> keeps everything.</p>\n</section>\n";
    return html;
  }
  html += kStage;
  html += still(scene, trajectory);
  if (!scene.loads.empty()) html += "<p class=\"note\">Red arrows are joint forces on the second body of each joint, orange ones applied forces.</p>\n";
  if (scene.n_unseen > 0) html += fmt::format("<p class=\"note\">{} of {} bodies were not recorded and are not drawn.</p>\n", scene.n_unseen, scene.bodies.size());
  return html + "</section>\n";
}

std::string plots(const Trajectory& trajectory, const PageContent& content) {
  if (content.rows.size() == trajectory.n_rows()) return "<div id=\"charts\"></div>\n";
  return fmt::format("<p class=\"note\">Pictures and plots show {} of {} rows, including the instants of the largest joint forces; the tables use all rows.</p>\n<div id=\"charts\"></div>\n",
                     content.rows.size(), trajectory.n_rows());
}

std::string section(const char* id, const char* title, const std::string& content) {
  return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}</h2>\n{2}</section>\n", id, title, content);
}

std::string script(const Scene& scene, const RunRecord& run, const PageContent& content) {
  std::string html = "<script type=\"application/json\" id=\"run\">" + page_data(scene, run, content) + "</script>\n<script>\n\"use strict\";\n";
  for (const char* part : {kPageValues, kPageClock, kPageStage, kPageChart, kPagePolar, kPageMain}) html += part;
  return html + "</script>\n";
}

}  // namespace

std::string report_html(const Model& model, const RunRecord& run, const ReportOptions& options) {
  const Trajectory& trajectory = run.trajectory;
  const Scene scene = make_scene(model, trajectory);
  const PageContent content = choose_content(trajectory, options.most_values);
  const bool rows = trajectory.n_rows() > 0;
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>{}: Pintle report</title>\n<style>\n{}</style>\n</head>\n<body>\n",
      escaped_markup(title_of(model, run)), kPageStyle);
  html += header(model, run) + "<main>\n";
  html += motion(scene, run);
  if (rows) html += section("plots", "Plots", plots(trajectory, content));
  html += section("forces-of-joints", "Peak joint forces", (trajectory.joints.empty() ? "<p>There are no joints.</p>\n" : force_table(trajectory)) + horizon_table(trajectory) + couple_table(trajectory) + event_table(trajectory) + heat_table(trajectory) + drive_tables(trajectory));
  if (!trajectory.bearings.empty()) html += section("bearings", "Bearings", bearing_section(trajectory.bearings));
  if (const std::string orbits = orbit_section(run); !orbits.empty()) html += section("orbits", "Orbits of pins", orbits);
  if (const std::string wear = wear_section(run); !wear.empty()) html += section("wear", "Wear", wear);
  html += section("energy", "Energy account", energy_table(trajectory.energy));
  html += section("assumed", "Assumptions", assumption_list(model, trajectory));
  html += section("work", "Computation", counter_table(trajectory));
  html += section("source", "Provenance", provenance(run.stamp));
  html += "</main>\n";
  if (rows) html += script(scene, run, content);
  return html + "</body>\n</html>\n";
}

}  // namespace pintle
