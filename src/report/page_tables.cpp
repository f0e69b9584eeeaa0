#include "report/page_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "results/bearing_text.h"
#include "results/plots/run_polar.h"
#include "results/event_kinds.h"
#include "results/force_quality.h"
#include "results/heat.h"
#include "results/plots/markup.h"
#include "results/plots/plot_ticks.h"
#include "results/text_table.h"

namespace pintle {
namespace {

constexpr std::size_t kMostRows = 2000;  // in a table; a longer one shows only the largest

/// Numbers as the console writes them, but with powers of ten as people write them.
std::string number(const std::string& text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text.starts_with('-') ? "−" + text.substr(1) : text;
  const int power = std::stoi(text.substr(e + 1));
  return fmt::format("{}·10<sup>{}{}</sup>", number(text.substr(0, e)), power < 0 ? "−" : "", std::abs(power));
}
std::string value(double x) { return number(engineering(x)); }
std::string estimate(double x) { return number(exponent(x)); }

class HtmlTable {
 public:
  explicit HtmlTable(const std::string& attributes) : attributes_(attributes) {}

  void head(const std::string& text, const std::string& unit = "", bool number = true) {
    heads_ += fmt::format("<th scope=\"col\"{}>{}{}</th>", number ? " class=\"n\"" : "", escaped_markup(text),
                          unit.empty() ? "" : fmt::format(" <span class=\"unit\">[{}]</span>", escaped_markup(printed_unit(unit))));
  }
  void begin_row(const std::string& attributes = "") { rows_ += "<tr" + attributes + ">"; }
  void name(const std::string& html) { rows_ += "<th scope=\"row\">" + html + "</th>"; }
  void text(const std::string& html) { rows_ += "<td>" + html + "</td>"; }
  void number(double sort, const std::string& html) { rows_ += fmt::format("<td class=\"n\" data-v=\"{}\">{}</td>", sort, html); }
  void number(double x) { number(x, value(x)); }
  void end_row() { rows_ += "</tr>\n"; }

  std::string html() const {
    return fmt::format("<div class=\"scroller\" tabindex=\"0\"><table{}>\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n", attributes_, heads_, rows_);
  }

 private:
  std::string attributes_, heads_, rows_;
};

std::string seconds(double s) {
  const AxisScale scale = scale_for(s, "s");
  return fmt::format("{:.3g} {}", s / scale.factor, scale.unit);
}

std::string jump_button(const LoadSummary& joint) {
  return fmt::format("<button class=\"jump\" data-t=\"{}\" title=\"Go to the peak of {}\">{}</button>", joint.peak_time,
                     escaped_markup(joint.name), value(joint.peak_time));
}

std::string count(std::size_t n, const char* one, const char* many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

/// All joints in their order, or if there are too many, the largest.
std::vector<const LoadSummary*> shown_joints(const Trajectory& trajectory) {
  std::vector<const LoadSummary*> list;
  for (const LoadSummary& joint : trajectory.joints) list.push_back(&joint);
  if (list.size() <= kMostRows) return list;
  std::stable_sort(list.begin(), list.end(), [](const LoadSummary* a, const LoadSummary* b) { return a->peak > b->peak; });
  list.resize(kMostRows);
  return list;
}

}  // namespace

Verdict verdict_on(const Trajectory& trajectory) {
  if (trajectory.outcome == Outcome::kFailed || trajectory.outcome == Outcome::kInterrupted)
    return {trajectory.outcome == Outcome::kFailed ? Verdict::kBad : Verdict::kDoubtful,
            fmt::format("{} at t = {:.6g} s{}{}", trajectory.outcome == Outcome::kFailed ? "The computation failed" : "Stopped by the user",
                        trajectory.t_end, trajectory.message.empty() ? "." : ": ", trajectory.message)};
  if (trajectory.outcome == Outcome::kRunaway || trajectory.outcome == Outcome::kEnergyOpen || trajectory.outcome == Outcome::kHorizon)
    return {trajectory.outcome == Outcome::kHorizon ? Verdict::kDoubtful : Verdict::kBad, trajectory.message + "."};
  const std::string asked = printed_number(fmt::format("{:g}", trajectory.tolerance));
  const LoadSummary* worst = nullptr;
  std::size_t n_missed = 0, n_ambiguous = 0;
  for (const LoadSummary& joint : trajectory.joints) {
    n_missed += misses_tolerance(joint, trajectory);
    n_ambiguous += !joint.unique;
    if (!worst || !(joint.relative_error_estimate <= worst->relative_error_estimate)) worst = &joint;
  }
  const std::string more = n_ambiguous ? fmt::format(" Forces of {} are not unique.", count(n_ambiguous, "joint", "joints")) : "";
  std::string of_forces;
  if (!worst) of_forces = "there are no joints.";
  else if (!has_force_estimates(trajectory)) of_forces = "the joint forces have no error estimate.";
  else of_forces = fmt::format("largest estimated error{}: {} of its peak, at {}.", trajectory.of_motion ? " of a joint force" : "", printed_number(exponent(worst->relative_error_estimate)), worst->name);
  of_forces += more;
  const bool met = trajectory.outcome == Outcome::kCompleted;
  const Verdict::Kind kind = met && !n_ambiguous ? Verdict::kGood : Verdict::kDoubtful;
  if (trajectory.of_motion)
    return {trajectory.motion_error <= trajectory.tolerance ? kind : Verdict::kDoubtful,
            fmt::format("Positions are accurate to {} of the longest path of any body (tolerance {}); {}", printed_number(exponent(trajectory.motion_error)), asked, of_forces)};
  if (met && !worst) return {Verdict::kGood, "Completed; " + of_forces};
  if (met && !n_missed) return {kind, fmt::format("Every joint force is accurate to {} of its peak; {}", asked, of_forces)};
  if (n_missed)
    return {Verdict::kDoubtful, fmt::format("{} the tolerance of {} of the peak; {}",
                                            n_missed == 1 ? "1 joint force misses" : fmt::format("{} joint forces miss", n_missed), asked, of_forces)};
  return {Verdict::kDoubtful, fmt::format("The tolerance of {} was not reached{}{}; {}", asked, trajectory.message.empty() ? "" : ": ", trajectory.message, of_forces)};
}

std::string facts_line(const Model& model, const Trajectory& trajectory) {
  return fmt::format("{:.6g} s of motion · {} · {} · method {}, {} · computed in {}", trajectory.t_end,
                     count(model.bodies.size(), "body", "bodies"), count(model.joints.size(), "joint", "joints"),
                     escaped_markup(trajectory.method), count(trajectory.counters.steps, "step", "steps"), seconds(trajectory.wall_seconds));
}

std::string force_table(const Trajectory& trajectory) {
  HtmlTable table(" id=\"force-table\" class=\"sortable\"");
  for (const char* head : {"plot", "joint", "type", "on", "by"}) table.head(head, "", false);
  table.head("peak force", "N");
  table.head("at t", "s");
  table.head("RMS", "N");
  table.head("mean", "N");
  table.head("est. error", "N");
  table.head("of peak");
  const auto joints = shown_joints(trajectory);
  const bool estimated = has_force_estimates(trajectory);
  bool any_missed = false, any_ambiguous = false, any_late = false;
  for (const LoadSummary* one : joints) {
    const LoadSummary& joint = *one;
    const bool missed = misses_tolerance(joint, trajectory);
    any_missed |= missed;
    any_ambiguous |= !joint.unique;
    const bool late = peaks_behind_horizon(joint, trajectory);
    any_late |= late;
    const std::string name = escaped_markup(joint.name);
    table.begin_row(fmt::format(" data-joint=\"{}\" data-t=\"{}\"{}", name, joint.peak_time, missed ? " class=\"missed\"" : ""));
    table.text(fmt::format("<input type=\"checkbox\" aria-label=\"Plot the force at {}\">", name));
    table.name(name + (joint.unique ? "" : " <span title=\"not unique\">†</span>"));
    table.text(escaped_markup(joint.type));
    table.text(escaped_markup(joint.second_body));
    table.text(escaped_markup(joint.first_body));
    table.number(joint.peak);
    table.number(joint.peak_time, jump_button(joint));
    table.number(joint.rms);
    table.number(joint.mean);
    table.number(joint.error_estimate, estimated ? estimate(joint.error_estimate) : "–");
    table.number(joint.relative_error_estimate, (estimated ? estimate(joint.relative_error_estimate) + (couple_decides(joint) ? " (couple)" : "") : "–") + (missed ? " <strong title=\"misses the tolerance\">!</strong>" : "") + (late ? " <strong title=\"the peak comes after the horizon\">~</strong>" : ""));
    table.end_row();
  }
  std::string html = table.html();
  if (joints.size() < trajectory.joints.size())
    html += fmt::format("<p class=\"note\">The largest {} of {} joints; summary.json has all.</p>\n", joints.size(), trajectory.joints.size());
  if (any_missed)
    html += fmt::format("<p class=\"note\"><strong>!</strong> the estimate exceeds the tolerance of {} of the peak</p>\n", printed_number(fmt::format("{:g}", trajectory.tolerance)));
  if (any_late) html += "<p class=\"note\"><strong>~</strong> the peak comes after the time up to which the force is promised; the error is that of the rows before</p>\n";
  if (any_ambiguous)
    html += "<p class=\"note\">† redundant ideal constraints leave this force undetermined; one of many solutions is given</p>\n";
  return html;
}

std::string horizon_table(const Trajectory& trajectory) {
  if (trajectory.outcome != Outcome::kHorizon) return "";
  HtmlTable table(" class=\"sortable\"");
  table.head("joint", "", false);
  table.head("promised to", "s");
  for (const char* head : {"peak after", "±", "RMS after", "±", "mean after", "±"}) table.head(head, "N");
  for (const LoadSummary* joint : shown_joints(trajectory)) {
    table.begin_row();
    table.name(escaped_markup(joint->name));
    table.number(joint->horizon);
    for (const auto& [of_rest, scatter] : {std::pair{joint->peak_after, joint->peak_scatter}, {joint->rms_after, joint->rms_scatter}, {joint->mean_after, joint->mean_scatter}}) {
      table.number(of_rest);
      table.number(scatter, estimate(scatter));
    }
    table.end_row();
  }
  return "<h3>Horizons, and statistics of the forces after them</h3>\n" + table.html() + "<p class=\"note\">±: how far two motions that agree up to there differ</p>\n";
}

std::string event_table(const Trajectory& trajectory) {
  const std::vector<EventKind> kinds = kinds_of_events(trajectory);
  if (kinds.empty()) return "";
  HtmlTable table(" class=\"sortable\"");
  for (const char* head : {"joint", "event"}) table.head(head, "", false);
  table.head("count");
  for (const char* head : {"first", "last"}) table.head(head, "s");
  table.head("fastest approach");
  table.head("most heat", "J");
  for (const EventKind& kind : kinds) {
    table.begin_row();
    table.name(escaped_markup(kind.joint));
    table.text(escaped_markup(kind.what));
    table.number(kind.count, fmt::format("{}", kind.count));
    table.number(kind.first);
    table.number(kind.last);
    table.number(kind.fastest_approach, kind.fastest_approach > 0 ? value(kind.fastest_approach) + " " + printed_unit(kind.approach_unit) : "");
    table.number(kind.most_heat, kind.most_heat > 0 ? value(kind.most_heat) : "");
    table.end_row();
  }
  return "<h3>Events</h3>\n" + table.html() + "<p class=\"note\">Most heat: since the joint's event before. events.csv has every event.</p>\n";
}

std::string couple_table(const Trajectory& trajectory) {
  HtmlTable table(" class=\"sortable\"");
  for (const char* head : {"joint", "on", "by"}) table.head(head, "", false);
  for (const char* head : {"peak couple", "RMS", "mean", "est. error"}) table.head(head, "N*m");
  const bool estimated = has_force_estimates(trajectory);
  bool any = false;
  for (const LoadSummary* joint : shown_joints(trajectory)) {
    if (!joint->has_moment) continue;
    any = true;
    table.begin_row();
    table.name(escaped_markup(joint->name));
    table.text(escaped_markup(joint->second_body));
    table.text(escaped_markup(joint->first_body));
    for (const double x : {joint->peak_moment, joint->rms_moment, joint->mean_moment}) table.number(x);
    table.number(joint->moment_error_estimate, estimated ? estimate(joint->moment_error_estimate) : "–");
    table.end_row();
  }
  return any ? "<h3>Couples about the second marker</h3>\n" + table.html() : "";
}

std::string heat_table(const Trajectory& trajectory) {
  const std::vector<const LoadSummary*> joints = joints_with_heat(trajectory);
  if (joints.empty()) return "";
  HtmlTable table(" class=\"sortable\"");
  table.head("joint", "", false);
  table.head("heat", "J");
  table.head("mean power", "W");
  table.head("of all");
  for (const LoadSummary* joint : joints) {
    table.begin_row();
    table.name(escaped_markup(joint->name));
    for (const double x : {joint->heat, joint->heat / trajectory.t_end, joint->heat / heat_of_all(trajectory)}) table.number(x);
    table.end_row();
  }
  return "<h3>Heat in joints</h3>\n" + table.html();
}

std::string drive_tables(const Trajectory& trajectory) {
  std::string html;
  if (!trajectory.motors.empty()) {
    HtmlTable table(" class=\"sortable\"");
    for (const char* head : {"motor", "joint"}) table.head(head, "", false);
    for (const char* head : {"peak", "RMS", "mean", "error est."}) table.head(head);
    table.head("unit", "", false);
    for (const char* head : {"peak power", "mean power"}) table.head(head, "W");
    table.head("work", "J");
    for (const MotorSummary& motor : trajectory.motors) {
      table.begin_row();
      table.name(escaped_markup(motor.name));
      table.text(escaped_markup(motor.joint));
      for (const double x : {motor.peak_effort, motor.rms_effort, motor.mean_effort}) table.number(x);
      table.number(motor.effort_error, std::isfinite(motor.effort_error) ? estimate(motor.effort_error) : "–");
      table.text(escaped_markup(printed_unit(motor.unit)));
      for (const double x : {motor.peak_power, motor.mean_power, motor.work}) table.number(x);
      table.end_row();
    }
    html += "<h3>Motors</h3>\n" + table.html();
  }
  if (trajectory.springs.empty()) return html;
  HtmlTable table(" class=\"sortable\"");
  for (const char* head : {"spring", "on", "by"}) table.head(head, "", false);
  for (const char* head : {"peak", "RMS", "mean"}) table.head(head);
  table.head("unit", "", false);
  for (const LoadSummary& spring : trajectory.springs) {
    const bool turns = spring.has_moment;
    table.begin_row();
    table.name(escaped_markup(spring.name));
    table.text(escaped_markup(spring.second_body));
    table.text(escaped_markup(spring.first_body));
    for (const double x : turns ? std::array{spring.peak_moment, spring.rms_moment, spring.mean_moment} : std::array{spring.peak, spring.rms, spring.mean})
      table.number(x);
    table.text(turns ? "N·m" : "N");
    table.end_row();
  }
  return html + "<h3>Springs</h3>\n" + table.html();
}

namespace {

std::string html_of(const BearingTable& from) {
  HtmlTable table(" class=\"sortable\"");
  table.head("joint", "", false);
  for (const BearingTable::Head& head : from.heads) table.head(head.text, head.unit);
  for (const BearingTable::Row& row : from.rows) {
    table.begin_row();
    table.name(escaped_markup(row.joint));
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const double x = row.values[i];
      table.number(x, std::isnan(x) ? "–" : from.heads[i].estimate ? estimate(x) : value(x));
    }
    table.end_row();
  }
  return "<h3>" + escaped_markup(from.title) + "</h3>\n" + table.html();
}

}  // namespace

std::string orbit_section(const RunRecord& run) {
  std::string html;
  for (const LoadSummary& joint : run.trajectory.joints)
    if (joint.type == "revolute" && has_orbit(run.trajectory, joint.name)) html += "<figure class=\"wear\">\n" + to_svg(make_orbit_plot({{"", &run}}, joint.name)) + "</figure>\n";
  return html;
}

std::string wear_section(const RunRecord& run) {
  const BearingTable table = wear_table(run.trajectory.wear);
  if (table.rows.empty()) return "";
  std::string html = html_of(table);
  for (const BearingTable::Row& row : table.rows) html += "<figure class=\"wear\">\n" + to_svg(make_wear_plot({{"", &run}}, row.joint)) + "</figure>\n";
  return html;
}

std::string bearing_section(const std::vector<BearingSummary>& bearings) {
  std::string html;
  for (const BearingTable& from : bearing_tables(bearings)) html += html_of(from);
  for (const std::string& note : bearing_notes(bearings)) html += "<p class=\"note\">" + escaped_markup(note) + "</p>\n";
  return html;
}

std::string energy_table(const EnergyAccount& energy) {
  HtmlTable table("");
  table.head("at the", "", false);
  for (const char* head : {"kinetic", "potential", "dissipated", "supplied"}) table.head(head, "J");
  table.begin_row();
  table.name("start");
  for (const double x : {energy.kinetic_start, energy.potential_start, 0.0, 0.0}) table.number(x);
  table.end_row();
  table.begin_row();
  table.name("end");
  for (const double x : {energy.kinetic_end, energy.potential_end, energy.dissipated, energy.supplied}) table.number(x);
  table.end_row();
  std::string note = fmt::format("kinetic + potential + dissipated − supplied drifts by {} J", estimate(energy.drift));
  if (is_moving(energy)) note += fmt::format(", {} of the peak kinetic energy", estimate(energy.drift / energy.kinetic_peak));
  return table.html() + "<p class=\"note\">" + note + ". Nothing in the method enforces this balance: it is an independent check.</p>\n";
}

std::string assumption_list(const Model& model, const Trajectory& trajectory) {
  std::string html = "<ul>\n";
  const auto item = [&html](const std::string& text) { html += "<li>" + text + "</li>\n"; };
  const SimulateSettings& settings = model.simulate;
  switch (settings.equations) {
    case Equations::kNewtonian: item("Every joint is a force law: it deflects under its force."); break;
    case Equations::kRelative: item("Joints marked ideal are rigid; every other joint is a force law."); break;
    case Equations::kIdeal: item("Every joint with a linear law is an ideal constraint."); break;
    case Equations::kPenalty: item("Every joint with a linear law is an ideal constraint, kept by a penalty."); break;
    case Equations::kAugmentedLagrangian: item("Every joint with a linear law is an ideal constraint, kept by the augmented Lagrangian method."); break;
    case Equations::kRelativeAugmented: item("Every joint with a linear law is an ideal constraint: relative coordinates, and the augmented Lagrangian method for what closes loops."); break;
  }
  switch (settings.start) {
    case Start::kAssembled: item("The start is assembled: positions, velocities and the preload of every joint are computed."); break;
    case Start::kSeated: item("The start is assembled, and joints with play are seated where their load presses them: positions, velocities and the preload of every joint are computed."); break;
    case Start::kSettled: item("The start is settled: the mechanism is at rest, in equilibrium under the loads of t = 0."); break;
    case Start::kUnloaded: item("The start has no joint preload."); break;
    case Start::kRaw: item("The start is used as stated, without preload; the resulting shock is part of the result."); break;
  }
  item(fmt::format("Gravity is {:g}, {:g} m/s² along x and y.", model.gravity[0], model.gravity[1]));
  item(fmt::format("Tolerance: {} of {}, at every output time.", printed_number(fmt::format("{:g}", trajectory.tolerance)), trajectory.of_motion ? "the longest path of any body" : "each joint's peak force"));
  item("Peaks are those of the whole motion, found between the output times too; plots show the output times, and mark the peaks.");
  for (const std::string& note : trajectory.notes) item(escaped_markup(note));
  return html + "</ul>\n";
}

std::string counter_table(const Trajectory& trajectory) {
  const Counters& n = trajectory.counters;
  HtmlTable table("");
  table.head("method", "", false);
  for (const char* head : {"steps", "rejected", "passes", "Newton iterations", "failures", "evaluations", "factorizations", "events"}) table.head(head);
  table.begin_row();
  table.name(escaped_markup(trajectory.method));
  for (const std::uint64_t x : {n.steps, n.rejected, n.passes, n.newton_iterations, n.newton_failures, n.evaluations, n.factorizations, n.events})
    table.number(static_cast<double>(x), fmt::format("{}", x));
  table.end_row();
  return table.html();
}

std::string provenance(const RunStamp& stamp) {
  std::string html = "<dl>\n";
  const auto entry = [&html](const char* what, const std::string& text) {
    if (!text.empty()) html += fmt::format("<dt>{}</dt><dd><code>{}</code></dd>\n", what, escaped_markup(text));
  };
  entry("Program", stamp.version.empty() ? "" : "Pintle " + stamp.version);
  entry("Command", stamp.command_line);
  entry("Model file", stamp.model_path);
  entry("File hash", stamp.input_hash);
  std::string changes;
  for (const std::string& change : stamp.overrides) changes += (changes.empty() ? "" : "; ") + change;
  entry("Overrides", changes);
  html += "</dl>\n";
  if (stamp.model_text.empty()) return html;
  html += "<details><summary>The model file</summary><pre tabindex=\"0\">";
  for (std::string_view rest = stamp.model_text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    html += escaped_markup(rest.substr(0, end)) + "\n";
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return html + "</pre></details>\n";
}

}  // namespace pintle
