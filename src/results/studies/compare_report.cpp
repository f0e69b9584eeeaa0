#include "results/studies/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "pintle/results.h"
#include "results/force_quality.h"
#include "results/text_table.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;
using Align = TextTable::Align;

constexpr std::size_t kMostPlotted = 3, kDots = 40;
constexpr double kMainShare = 0.5;  // as a fraction of the elastic energy: above this, one joint dominates

std::string word(Cause cause) {
  switch (cause) {
    case Cause::kNone:
      return "";
    case Cause::kNumerical:
      return "numerical";
    case Cause::kPhysical:
      return "physical";
    case Cause::kNotUnique:
      return "not unique";
    case Cause::kChaotic:
      return "chaotic";
    case Cause::kNoEstimate:
      return "unknown";
  }
  return "";
}

std::string table_text(const std::vector<Difference>& list, const char* head, bool judged) {
  TextTable table;
  table.add_column(head, Align::kLeft);
  table.add_column("peak", Align::kNumber);
  table.add_column("largest diff.", Align::kNumber);
  table.add_column("unit", Align::kLeft);
  table.add_column("at t", Align::kNumber, "s");
  table.add_column("of peak", Align::kNumber, "-");
  table.add_column("RMS of peak", Align::kNumber, "-");
  table.add_column("digits", Align::kNumber);
  if (judged) {
    table.add_column("error est.", Align::kNumber);
    table.add_column("difference is", Align::kLeft);
  }
  for (const Difference& d : list) {
    const auto of_peak = [](double relative) { return relative * std::numeric_limits<double>::epsilon() < 1 ? exponent(relative) : "-"; };  // otherwise the peak is roundoff
    std::vector<std::string> row{d.name,           engineering(d.peak),          exponent(d.largest), d.unit, engineering(d.largest_time),
                                 of_peak(d.relative), of_peak(d.relative_rms), fmt::format("{}", d.digits)};
    if (judged) {
      row.push_back(std::isnan(d.error_estimate) ? "-" : exponent(d.error_estimate));
      row.push_back(word(d.cause));
    }
    table.add_row(std::move(row));
  }
  return table.text();
}

bool any(const std::vector<Difference>& list, Cause cause) {
  return std::any_of(list.begin(), list.end(), [cause](const Difference& d) { return d.cause == cause; });
}

// The notes of start_of_run about laws that equations with ideal joints ignore.
std::vector<std::string> notes_of_lost_laws(const Trajectory& run) {
  std::vector<std::string> lost;
  std::copy_if(run.notes.begin(), run.notes.end(), std::back_inserter(lost), [](const std::string& note) { return note.find("not in these equations") != std::string::npos; });
  return lost;
}

// Explains the causes, and which joints deflect most.
std::string explanation(const Comparison& c) {
  std::string text;
  if (any(c.forces, Cause::kNumerical)) text += "  numerical: within the error estimates of both runs; a smaller tolerance would reduce it\n";
  if (any(c.forces, Cause::kPhysical) || any(c.couples, Cause::kPhysical)) {
    const auto lost = notes_of_lost_laws(c.second);
    text += lost.empty() ? "  physical: larger than the error estimates; it comes from joint compliance and goes as 1 / stiffness\n"
                         : "  physical: larger than the error estimates; it comes from joint compliance, and from what the second run lacks:\n";
    for (const std::string& note : lost) text += "    " + note + "\n";
    if (c.against == Equations::kPenalty) text += "    the penalties' own error is in it too, and goes as 1 / penalty\n";
    if (!c.softness.empty() && c.softness.front().share > 0)
      text += fmt::format("    {} stores {:.0f} % of the joints' elastic energy{}\n", c.softness.front().joint, 100 * c.softness.front().share,
                          c.softness.front().share > kMainShare ? ", most of it" : ", the largest share");
  }
  if (any(c.forces, Cause::kNotUnique)) text += "  not unique: ideal joints leave this load sharing undetermined\n";
  if (any(c.forces, Cause::kNoEstimate)) text += "  unknown: a run stopped before a second integration, and has no error estimate\n";
  if (std::isfinite(c.until)) text += fmt::format("  compared up to t = {:.5g} s, to which forces are promised: the motion is chaotic, and two runs of it have no peaks in common after that\n", c.until);
  return text;
}

// Whether the run reached its end, whatever the accuracy of its forces.
bool is_whole(const Trajectory& run) { return run.outcome == Outcome::kCompleted || run.outcome == Outcome::kHorizon || run.outcome == Outcome::kToleranceNotMet; }

std::string run_line(const Trajectory& run, const std::string& name) {
  return fmt::format("  {}: method {}, {} steps, {}{}{}\n", name, run.method, run.counters.steps,
                     is_whole(run) ? to_text(run.outcome) : fmt::format("stopped at t = {:.6g} s", run.t_end), run.message.empty() ? "" : ": ",
                     run.message);
}

Json to_json(const Difference& d) {
  return Json{{"name", d.name}, {"unit", d.unit}, {"peak", d.peak}, {"largest", d.largest}, {"largest_time", d.largest_time}, {"rms", d.rms},
              {"relative", d.relative}, {"relative_rms", d.relative_rms}, {"digits", d.digits}, {"error_estimate", d.error_estimate}, {"cause", word(d.cause)}};
}

Json to_json(const std::vector<Difference>& list) {
  Json json = Json::array();
  for (const Difference& d : list) json.push_back(to_json(d));
  return json;
}

std::vector<double> magnitude(const Trajectory& run, const std::string& path, const std::vector<double>& times) {
  const int x = run.column(path + "fx[world]"), y = run.column(path + "fy[world]");
  std::vector<double> out(times.size(), std::nan(""));
  for (std::size_t i = 0; i < std::min(times.size(), run.n_rows()) && x >= 0 && y >= 0; ++i)
    out[i] = std::hypot(run.at(i, static_cast<std::size_t>(x)), run.at(i, static_cast<std::size_t>(y)));
  return out;
}

std::vector<double> times_of(const Trajectory& run) {
  std::vector<double> times;
  for (std::size_t i = 0; i < run.n_rows(); ++i) times.push_back(run.at(i, 0));
  return times;
}

TextTable runs_table(const Variants& v) {
  TextTable table;
  for (const char* head : {"run", "method"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"steps", "passes"}) table.add_column(head, Align::kNumber);
  table.add_column("computed in", Align::kNumber, "s");
  table.add_column("up to t", Align::kNumber, "s");
  table.add_column("", Align::kLeft);
  for (const NamedRun& one : v.runs)
    table.add_row({one.name, one.run.method, fmt::format("{}", one.run.counters.steps), fmt::format("{}", one.run.counters.passes), engineering(one.run.wall_seconds), engineering(one.run.t_end),
                   to_text(one.run.outcome)});
  return table;
}

// Small changes with one digit, so that none is printed as zero.
std::string percent(double change) {
  if (!std::isfinite(change)) return "-";
  return std::abs(change) >= 1e-3 || change == 0 ? fmt::format("{:+.2f} %", 100 * change) : fmt::format("{:+.1g} %", 100 * change);
}

TextTable loads_table(const Variants& v) {
  TextTable table;
  for (const char* head : {"joint", "run"}) table.add_column(head, Align::kLeft);
  for (const char* head : {"peak", "mean", "RMS"}) {
    table.add_column(head, Align::kNumber, "N");
    table.add_column("change", Align::kNumber);
  }
  table.add_column("error est.", Align::kNumber, "N");
  table.add_column("peak differs", Align::kLeft);
  for (const VariantJoint& joint : v.joints)
    for (std::size_t i = 0; i < v.runs.size(); ++i) {
      const VariantLoad& one = joint.loads[i];
      const std::string name = i == 0 ? joint.joint : "";
      if (!one.there) {
        table.add_row({name, v.runs[i].name, "-", "", "-", "", "-"});
        continue;
      }
      const auto change = [i](double x) { return i == 0 ? "" : percent(x); };
      table.add_row({name, v.runs[i].name, engineering(one.load.peak), change(one.peak_change), engineering(one.load.mean), change(one.mean_change), engineering(one.load.rms), change(one.rms_change),
                     has_force_estimates(v.runs[i].run) ? exponent(one.load.error_estimate) : "-", i == 0 ? "" : word(one.cause)});
    }
  return table;
}

// A subset of many values, for dots on a line.
std::vector<double> sparse(std::vector<double> y) {
  const std::size_t step = std::max<std::size_t>(1, y.size() / kDots);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (i % step != 0) y[i] = std::nan("");
  return y;
}

}  // namespace

std::string to_text(Equations equations) {
  switch (equations) {
    case Equations::kNewtonian: return "compliant joints";
    case Equations::kRelative: return "relative coordinates";
    case Equations::kIdeal: return "ideal joints";
    case Equations::kPenalty: return "ideal joints by penalties";
    case Equations::kAugmentedLagrangian: return "ideal joints by augmented Lagrangian";
    case Equations::kRelativeAugmented: return "relative coordinates by augmented Lagrangian";
  }
  return "";
}

std::string compare_text(const Comparison& c, const std::string& title, bool colour) {
  const std::string bold = colour ? "\x1b[1m" : "", plain = colour ? "\x1b[0m" : "";
  std::string text = fmt::format("{}{}{}: compliant joints against {}\n", bold, title, plain, to_text(c.against));
  text += run_line(c.first, "compliant joints") + run_line(c.second, to_text(c.against));
  if (!c.forces.empty()) text += "\nJoint forces (difference of the vectors)\n" + table_text(c.forces, "joint", true);
  if (!c.couples.empty()) text += "\nJoint couples\n" + table_text(c.couples, "joint", true);
  text += explanation(c);
  if (!c.coordinates.empty()) text += "\nCoordinates\n" + table_text(c.coordinates, "column", false);
  if (!c.second.notes.empty()) {
    text += "\nNotes on " + to_text(c.against) + "\n";
    for (const std::string& note : c.second.notes) text += "  " + note + "\n";
  }
  return text;
}

std::string compare_json(const Comparison& c, const std::string& model_name, const std::string& model_path) {
  Json json;
  json["model"] = model_name;
  json["model_path"] = model_path;
  json["against"] = to_word(c.against);
  json["forces"] = to_json(c.forces);
  json["couples"] = to_json(c.couples);
  json["coordinates"] = to_json(c.coordinates);
  json["softness"] = Json::array();
  for (const Softness& s : c.softness) json["softness"].push_back({{"joint", s.joint}, {"share", s.share}});
  json["notes"] = c.second.notes;
  return json.dump(2) + "\n";
}

std::string variants_text(const Variants& v, bool colour) {
  const std::string bold = colour ? "\x1b[1m" : "", plain = colour ? "\x1b[0m" : "";
  std::string text = fmt::format("{} runs side by side; changes are of the first\n\n", v.runs.size()) + runs_table(v).text(bold, plain);
  text += "\nJoint forces (magnitude)\n" + loads_table(v).text(bold, plain);
  const auto is = [&v](Cause cause) {
    return std::any_of(v.joints.begin(), v.joints.end(), [cause](const VariantJoint& joint) {
      return std::any_of(joint.loads.begin() + 1, joint.loads.end(), [cause](const VariantLoad& one) { return one.there && one.cause == cause; });
    });
  };
  if (is(Cause::kNumerical)) text += "  numerical: the peaks differ by no more than the error estimates of both runs\n";
  if (is(Cause::kPhysical)) text += "  physical: the peaks differ by more than the error estimates\n";
  if (is(Cause::kChaotic)) text += "  chaotic: a peak comes after the time up to which its force is promised, where only statistics of long runs can be compared\n";
  if (is(Cause::kNoEstimate)) text += "  unknown: a run stopped before a second integration, and has no error estimate\n";
  for (const NamedRun& one : v.runs) {
    if (!one.run.message.empty()) text += fmt::format("\n{}: {}\n", one.name, one.run.message);
    if (!one.run.notes.empty()) text += "\nNotes on " + one.name + "\n";
    for (const std::string& note : one.run.notes) text += "  " + note + "\n";
  }
  return text;
}

std::string variants_json(const Variants& v, const std::vector<std::string>& model_paths) {
  Json json;
  json["runs"] = Json::array();
  for (std::size_t i = 0; i < v.runs.size(); ++i) {
    const Trajectory& run = v.runs[i].run;
    json["runs"].push_back({{"name", v.runs[i].name}, {"model_path", model_paths[i]}, {"method", run.method}, {"outcome", to_text(run.outcome)}, {"message", run.message}, {"t_end", run.t_end},
                            {"steps", run.counters.steps}, {"passes", run.counters.passes}, {"wall_seconds", run.wall_seconds}, {"notes", run.notes}});
  }
  json["joints"] = Json::array();
  for (const VariantJoint& joint : v.joints) {
    Json loads = Json::array();
    for (const VariantLoad& one : joint.loads)
      loads.push_back(!one.there ? Json() : Json{{"peak", one.load.peak}, {"peak_time", one.load.peak_time}, {"mean", one.load.mean}, {"rms", one.load.rms}, {"error_estimate", one.load.error_estimate},
                                                 {"peak_change", one.peak_change}, {"mean_change", one.mean_change}, {"rms_change", one.rms_change}, {"peak_difference_is", word(one.cause)}});
    json["joints"].push_back({{"joint", joint.joint}, {"loads", std::move(loads)}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Plot variants_plot(const Variants& v, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.subtitle = fmt::format("{} runs side by side", v.runs.size());
  plot.x_quantity = "Time";
  plot.x_unit = "s";
  std::vector<std::pair<double, const VariantJoint*>> order;
  for (const VariantJoint& joint : v.joints) {
    double most = 0;
    for (const VariantLoad& one : joint.loads)
      if (one.there && std::isfinite(one.peak_change)) most = std::max(most, std::abs(one.peak_change));
    order.emplace_back(most, &joint);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [change, joint] : order) {
    if (plot.panels.size() == kMostPlotted) break;
    Panel panel{"Force at " + joint->joint, "N", {}, false, plot.x_quantity, plot.x_unit};
    for (std::size_t i = 0; i < v.runs.size(); ++i) {
      if (!joint->loads[i].there) continue;
      Curve curve{v.runs[i].name, "", {}};
      curve.x = times_of(v.runs[i].run);
      curve.y = magnitude(v.runs[i].run, "joint." + joint->joint + ".on_" + joint->loads[i].load.second_body + ".", curve.x);
      curve.style = static_cast<int>(i);
      panel.curves.push_back(std::move(curve));
    }
    plot.panels.push_back(std::move(panel));
  }
  plot.panel_height = 180;
  return plot;
}

Plot compare_plot(const Comparison& c, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.subtitle = fmt::format("compliant joints against {}", to_text(c.against));
  plot.x_quantity = "Time";
  plot.x_unit = "s";
  for (std::size_t i = 0; i < std::min(c.first.n_rows(), c.second.n_rows()); ++i) plot.x.push_back(c.first.at(i, 0));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < c.forces.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return c.forces[a].relative > c.forces[b].relative; });
  Panel gaps{"Difference of the force vectors", "N", {}};
  for (const std::size_t j : order) {
    if (plot.panels.size() == kMostPlotted) break;
    const LoadSummary& joint = c.first.joints[j];
    const std::string path = "joint." + joint.name + ".on_" + joint.second_body + ".";
    plot.panels.push_back({"Force at " + joint.name, "N", {{"compliant", "", magnitude(c.first, path, plot.x)}, {to_text(c.against), "", sparse(magnitude(c.second, path, plot.x)), true}}});
    Curve gap{joint.name, "", std::vector<double>(plot.x.size(), 0)};
    for (const char* component : {"fx[world]", "fy[world]"}) {
      const int a = c.first.column(path + component), b = c.second.column(path + component);
      for (std::size_t i = 0; i < plot.x.size() && a >= 0 && b >= 0; ++i)
        gap.y[i] = std::hypot(gap.y[i], c.first.at(i, static_cast<std::size_t>(a)) - c.second.at(i, static_cast<std::size_t>(b)));
    }
    gaps.curves.push_back(std::move(gap));
  }
  if (!gaps.curves.empty()) plot.panels.push_back(std::move(gaps));
  plot.panel_height = 180;
  return plot;
}

}  // namespace pintle
