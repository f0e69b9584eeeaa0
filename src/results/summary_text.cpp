// The summary of a run as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "pintle/results.h"
#include "results/bearing_text.h"
#include "results/event_kinds.h"
#include "results/force_quality.h"
#include "results/heat.h"
#include "results/text_table.h"

namespace pintle {
namespace {

using Align = TextTable::Align;

struct Style {
  std::string bold, warn, plain;
  explicit Style(bool colour)
      : bold(colour ? "\x1b[1m" : ""), warn(colour ? "\x1b[1;31m" : ""), plain(colour ? "\x1b[0m" : "") {}
};

constexpr std::size_t kFull = 200;  // a longer list is cut to its largest entries
constexpr std::size_t kCut = 20;

/// The entries to print, in their order: all of them, or if the list is long, the largest by `size`.
template <class Entry, class Size>
std::vector<const Entry*> shown(const std::vector<const Entry*>& all, const Size& size) {
  if (all.size() <= kFull) return all;
  std::vector<const Entry*> largest = all;
  const auto larger = [&size](const Entry* a, const Entry* b) { return size(*a) > size(*b); };
  std::stable_sort(largest.begin(), largest.end(), larger);
  largest.resize(kCut);
  return largest;
}

template <class Entry>
std::vector<const Entry*> pointers(const std::vector<Entry>& entries) {
  std::vector<const Entry*> out;
  for (const Entry& entry : entries) out.push_back(&entry);
  return out;
}

std::string rest_line(std::size_t n) {
  return n > kFull ? fmt::format("  the largest {} of {}; summary.json has all\n", kCut, n) : "";
}

double size_of(const LoadSummary& load) { return std::max(std::abs(load.peak), std::abs(load.peak_moment)); }

/// Seconds with a suitable prefix.
std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  return fmt::format("{:.1f} min", seconds / 60);
}

std::string heading(const Trajectory& trajectory, const RunStamp& stamp, const Style& style) {
  const bool good = trajectory.outcome == Outcome::kCompleted;
  std::string word = to_text(trajectory.outcome);
  std::replace(word.begin(), word.end(), '_', ' ');
  const std::string name = stamp.model_name.empty() ? stamp.model_path : stamp.model_name;
  std::string text = fmt::format("{}{}{}\n{}{}{}: {:.6g} s of model time in {}, {} output rows\n", style.bold, name,
                                 style.plain, good ? "" : style.warn, word, style.plain, trajectory.t_end,
                                 duration_text(trajectory.wall_seconds), trajectory.n_rows());
  if (!trajectory.message.empty()) text += fmt::format("  {}\n", trajectory.message);
  return text;
}

std::string section(const std::string& title, const TextTable& table, const Style& style) {
  return table.empty() ? "" : fmt::format("\n{}\n{}", title, table.text(style.bold, style.plain));
}

std::string joint_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  for (const char* head : {"joint", "type", "on", "by"}) table.add_column(head, Align::kLeft);
  table.add_column("peak", Align::kNumber, "N");
  table.add_column("at t", Align::kNumber, "s");
  table.add_column("RMS", Align::kNumber, "N");
  table.add_column("error est.", Align::kNumber, "N");
  table.add_column("of peak", Align::kNumber, "-");
  table.add_column("", Align::kLeft);
  const LoadSummary* worst = nullptr;
  std::size_t n_marked = 0;
  bool later = false;
  const bool estimated = has_force_estimates(trajectory);
  const auto joints = pointers(trajectory.joints);
  for (const LoadSummary* one : shown(joints, [](const LoadSummary& load) { return load.peak; })) {
    const LoadSummary& load = *one;
    const bool marked = misses_tolerance(load, trajectory), beyond = peaks_behind_horizon(load, trajectory);
    later = later || beyond;
    table.add_row({load.name, load.type, load.second_body, load.first_body, engineering(load.peak),
                   engineering(load.peak_time), engineering(load.rms), estimated ? exponent(load.error_estimate) : "-",
                   estimated ? exponent(load.relative_error_estimate) : "-", (marked ? style.warn + "<" + style.plain : "") + (beyond ? style.warn + "~" + style.plain : "") + (estimated && couple_decides(load) ? " (couple)" : "") + (load.unique ? "" : " not unique")});
  }
  std::string text = section("Joint forces (magnitude)", table, style) + rest_line(joints.size());
  if (later) text += fmt::format("  {}~{} the peak comes after the time up to which the force is promised; the error is that of the rows before\n", style.warn, style.plain);
  for (const LoadSummary* load : joints) {
    if (!misses_tolerance(*load, trajectory)) continue;
    ++n_marked;
    if (!worst || load->relative_error_estimate > worst->relative_error_estimate) worst = load;
  }
  if (worst)
    text += fmt::format("  {}<{} the estimate exceeds the tolerance of {:g} of the peak{}\n", style.warn, style.plain, trajectory.tolerance,
                        joints.size() > kFull ? fmt::format(": {} joints, the worst is {}", n_marked, worst->name) : "");
  return text;
}

std::string horizon_section(const Trajectory& trajectory, const Style& style) {
  if (trajectory.outcome != Outcome::kHorizon) return "";
  TextTable table;
  table.add_column("joint", Align::kLeft);
  table.add_column("promised to", Align::kNumber, "s");
  for (const char* head : {"peak", "+-", "RMS", "+-", "mean", "+-"}) table.add_column(head, Align::kNumber, "N");
  const auto joints = pointers(trajectory.joints);
  for (const LoadSummary* load : shown(joints, [](const LoadSummary& one) { return -one.horizon; }))
    table.add_row({load->name, engineering(load->horizon), engineering(load->peak_after), exponent(load->peak_scatter), engineering(load->rms_after), exponent(load->rms_scatter),
                   engineering(load->mean_after), exponent(load->mean_scatter)});
  return section("Horizons, and statistics of the forces after them (+-: how far two motions that agree up to there differ)", table, style) + rest_line(joints.size());
}

std::string moment_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  for (const char* head : {"joint", "on", "by"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"peak", "RMS", "mean", "error est."}) table.add_column(head, Align::kNumber, "N*m");
  const bool estimated = has_force_estimates(trajectory);
  std::vector<const LoadSummary*> joints = pointers(trajectory.joints);
  std::erase_if(joints, [](const LoadSummary* load) { return !load->has_moment; });
  for (const LoadSummary* load : shown(joints, [](const LoadSummary& one) { return one.peak_moment; }))
    table.add_row({load->name, load->second_body, load->first_body, engineering(load->peak_moment),
                   engineering(load->rms_moment), engineering(load->mean_moment), estimated ? exponent(load->moment_error_estimate) : "-"});
  return section("Joint couples about the second marker (magnitude)", table, style) + rest_line(joints.size());
}

std::string spring_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  for (const char* head : {"spring", "on", "by"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"peak", "RMS", "mean"}) table.add_column(head, Align::kNumber);
  table.add_column("unit", Align::kLeft);
  const auto springs = pointers(trajectory.springs);
  for (const LoadSummary* one : shown(springs, size_of)) {
    const LoadSummary& load = *one;
    const bool turns = load.has_moment;
    table.add_row({load.name, load.second_body, load.first_body, engineering(turns ? load.peak_moment : load.peak),
                   engineering(turns ? load.rms_moment : load.rms), engineering(turns ? load.mean_moment : load.mean),
                   turns ? "N*m" : "N"});
  }
  return section("Springs (magnitude)", table, style) + rest_line(springs.size());
}

std::string motor_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  for (const char* head : {"motor", "joint"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"peak", "RMS", "mean", "error est."}) table.add_column(head, Align::kNumber);
  table.add_column("unit", Align::kLeft);
  for (const char* head : {"peak power", "mean power"}) table.add_column(head, Align::kNumber, "W");
  table.add_column("work", Align::kNumber, "J");
  const auto motors = pointers(trajectory.motors);
  for (const MotorSummary* motor : shown(motors, [](const MotorSummary& one) { return std::abs(one.peak_power); }))
    table.add_row({motor->name, motor->joint, engineering(motor->peak_effort), engineering(motor->rms_effort),
                   engineering(motor->mean_effort), std::isfinite(motor->effort_error) ? exponent(motor->effort_error) : "-", motor->unit, engineering(motor->peak_power),
                   engineering(motor->mean_power), engineering(motor->work)});
  return section("Motors", table, style) + rest_line(motors.size());
}

std::string event_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  for (const char* head : {"joint", "event"}) table.add_column(head, Align::kLeft);
  table.add_column("count", Align::kNumber);
  for (const char* head : {"first", "last"}) table.add_column(head, Align::kNumber, "s");
  table.add_column("fastest approach", Align::kNumber);
  table.add_column("unit", Align::kLeft);
  table.add_column("most heat", Align::kNumber, "J");
  for (const EventKind& kind : kinds_of_events(trajectory)) {
    const bool touches = kind.fastest_approach > 0;
    table.add_row({kind.joint, kind.what, fmt::format("{}", kind.count), engineering(kind.first), engineering(kind.last), touches ? engineering(kind.fastest_approach) : "", touches ? kind.approach_unit : "",
                   kind.most_heat > 0 ? engineering(kind.most_heat) : ""});
  }
  return section("Events in joints (most heat: since the joint's event before; events.csv has all)", table, style);
}

std::string heat_section(const Trajectory& trajectory, const Style& style) {
  TextTable table;
  table.add_column("joint", Align::kLeft);
  table.add_column("heat", Align::kNumber, "J");
  table.add_column("mean power", Align::kNumber, "W");
  table.add_column("of all", Align::kNumber, "-");
  const auto joints = joints_with_heat(trajectory);
  for (const LoadSummary* load : shown(joints, [](const LoadSummary& one) { return std::abs(one.heat); }))
    table.add_row({load->name, engineering(load->heat), engineering(load->heat / trajectory.t_end), engineering(load->heat / heat_of_all(trajectory))});
  return section("Heat in joints", table, style) + rest_line(joints.size());
}

std::string energy_section(const EnergyAccount& energy, const Style& style) {
  TextTable table;
  table.add_column("", Align::kLeft);
  for (const char* head : {"kinetic", "potential", "dissipated", "supplied"})
    table.add_column(head, Align::kNumber, "J");
  table.add_row({"start", engineering(energy.kinetic_start), engineering(energy.potential_start), "0", "0"});
  table.add_row({"end", engineering(energy.kinetic_end), engineering(energy.potential_end),
                 engineering(energy.dissipated), engineering(energy.supplied)});
  std::string text = section("Energy account", table, style);
  text += fmt::format("  kinetic + potential + dissipated - supplied drifts by {} J", exponent(energy.drift));
  if (is_moving(energy))
    text += fmt::format(" ({} of the peak kinetic energy)", exponent(energy.drift / energy.kinetic_peak));
  return text + "\n";
}

std::string work_section(const Trajectory& trajectory) {
  const Counters& n = trajectory.counters;
  const std::string motion = !trajectory.of_motion ? "" : fmt::format(" of the motion (error {} of the longest path)", exponent(trajectory.motion_error));
  return fmt::format(
      "\nMethod {}, tolerance {:g}{}: {} steps ({} rejected) in {} {}\n"
      "  {} Newton iterations ({} failures), {} evaluations, {} factorizations{}\n",
      trajectory.method, trajectory.tolerance, motion, n.steps, n.rejected, n.passes, n.passes == 1 ? "pass" : "passes",
      n.newton_iterations, n.newton_failures, n.evaluations, n.factorizations, n.events == 0 ? "" : fmt::format(", {} event{}", n.events, n.events == 1 ? "" : "s"));
}

}  // namespace

std::string summary_text(const Trajectory& trajectory, const RunStamp& stamp, bool colour) {
  const Style style(colour);
  std::string text = heading(trajectory, stamp, style);
  text += joint_section(trajectory, style);
  text += horizon_section(trajectory, style);
  text += moment_section(trajectory, style);
  text += spring_section(trajectory, style);
  text += motor_section(trajectory, style);
  text += event_section(trajectory, style);
  text += heat_section(trajectory, style);
  text += bearing_text(trajectory.bearings, style.bold, style.plain);
  text += wear_text(trajectory.wear, style.bold, style.plain);
  text += energy_section(trajectory.energy, style);
  text += work_section(trajectory);
  const std::size_t n_notes = trajectory.notes.size(), n_shown = n_notes > kFull ? kCut : n_notes;
  if (n_notes > 0) text += "\nNotes\n";
  for (std::size_t i = 0; i < n_shown; ++i) text += fmt::format("  {}\n", trajectory.notes[i]);
  if (n_shown < n_notes) text += fmt::format("  and {} more; summary.json has all\n", n_notes - n_shown);
  return text;
}

}  // namespace pintle
