#include "results/studies/stiffen_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/text_table.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;
using Align = TextTable::Align;

constexpr std::size_t kMostShown = 6;  // number of quantities in the table of steps, and of curves

std::string steps_text(const Stiffening& s) {
  TextTable table;
  table.add_column("stiffness", Align::kNumber, "N/m");
  for (std::size_t i = 0; i < std::min(kMostShown, s.limits.size()); ++i) table.add_column("peak " + s.limits[i].name, Align::kNumber, s.limits[i].unit);
  table.add_column("largest change", Align::kNumber, "-");
  table.add_column("at", Align::kLeft);
  table.add_column("error est.", Align::kNumber, "-");
  for (const StiffenStep& step : s.steps) {
    std::vector<std::string> row{fmt::format("{:.0e}", step.stiffness)};
    for (std::size_t i = 0; i < std::min(kMostShown, s.limits.size()); ++i) row.push_back(fmt::format("{:.8g}", step.peaks[i]));
    row.push_back(std::isnan(step.change) ? "" : exponent(step.change));
    row.push_back(step.where);
    row.push_back(exponent(step.error_estimate));
    table.add_row(std::move(row));
  }
  return table.text();
}

std::string limits_text(const Stiffening& s) {
  TextTable table;
  table.add_column(s.request.motion_only ? "coordinate" : "joint", Align::kLeft);
  table.add_column("stiffest run", Align::kNumber);
  table.add_column("limit", Align::kNumber);
  table.add_column("error of limit", Align::kNumber);
  table.add_column("unit", Align::kLeft);
  table.add_column("digits agreed", Align::kNumber);
  for (const StiffenLimit& limit : s.limits)
    table.add_row({limit.name, fmt::format("{:.9g}", limit.peak), fmt::format("{:.9g}", limit.limit), exponent(limit.error), limit.unit, fmt::format("{}", limit.digits)});
  return table.text();
}

std::string joints_text(const Stiffening& s) {
  TextTable table;
  table.add_column("joint", Align::kLeft);
  table.add_column("type", Align::kLeft);
  table.add_column("stiffness", Align::kNumber, "N/m");
  table.add_column("damping", Align::kNumber, "N*s/m");
  table.add_column("angular stiffness", Align::kNumber, "N*m/rad");
  table.add_column("angular damping", Align::kNumber, "N*m*s/rad");
  table.add_column("influence", Align::kNumber, "-");
  table.add_column("", Align::kLeft);
  for (const StiffenJoint& j : s.joints) {
    const bool angle = j.angular_stiffness > 0;
    table.add_row({j.name, j.type, fmt::format("{:.0e}", j.stiffness), fmt::format("{:.4g}", j.damping), angle ? fmt::format("{:.4g}", j.angular_stiffness) : "",
                   angle ? fmt::format("{:.4g}", j.angular_damping) : "", j.influence > 0 ? exponent(j.influence) : "", j.kept ? "as stated" : ""});
  }
  return table.text();
}

// Whether the changes decrease, so that there is a limit to extrapolate to.
bool converges(const Stiffening& s) {
  const std::size_t n = s.steps.size();
  return s.found || (n > 2 && s.steps[n - 1].change < 0.2 * s.steps[n - 2].change);
}

std::string chosen(const StiffenRequest& request) {
  if (request.motion_only) return "coordinates";
  if (request.joints.empty()) return "all joint forces";
  std::string names;
  for (const std::string& name : request.joints) names += (names.empty() ? "" : ", ") + name;
  return "the forces at " + names;
}

}  // namespace

std::string stiffen_text(const Stiffening& s, const std::string& title, bool colour) {
  const std::string bold = colour ? "\x1b[1m" : "", plain = colour ? "\x1b[0m" : "";
  const std::string damping = s.request.damping_ratio ? fmt::format("damping {:g} of critical", *s.request.damping_ratio) : fmt::format("damping {:g} N*s/m", s.request.damping);
  std::string text = fmt::format("{}{}{}: {} digits of {} requested, {}\n\n", bold, title, plain, s.request.digits, chosen(s.request), damping);
  text += steps_text(s);
  if (s.found) text += fmt::format("\nFound: the digits agree at {:.0e} N/m.\n", s.stiffness);
  else text += "\nNot found.\n";
  if (!s.reason.empty()) text += "  " + s.reason + "\n";
  for (const std::string& note : s.notes) text += "  " + note + "\n";
  if (converges(s)) text += "\nLimit of stiff joints, extrapolated in 1/stiffness (peaks over the run)\n" + limits_text(s);
  if (s.found) text += "\nRecommended\n" + joints_text(s);
  return text;
}

std::string stiffen_json(const Stiffening& s, const std::string& model_name, const std::string& model_path) {
  Json json;
  json["model"] = model_name;
  json["model_path"] = model_path;
  json["digits"] = s.request.digits;
  json["found"] = s.found;
  json["stiffness"] = s.stiffness;
  json["reason"] = s.reason;
  json["notes"] = s.notes;
  json["quantities"] = s.quantities;
  json["steps"] = Json::array();
  for (const StiffenStep& step : s.steps)
    json["steps"].push_back({{"stiffness", step.stiffness}, {"change", step.change}, {"where", step.where}, {"error_estimate", step.error_estimate}, {"peaks", step.peaks}, {"changes", step.changes}});
  json["limits"] = Json::array();
  for (const StiffenLimit& limit : s.limits)
    json["limits"].push_back({{"name", limit.name}, {"unit", limit.unit}, {"peak", limit.peak}, {"limit", limit.limit}, {"error", limit.error}, {"digits", limit.digits}});
  json["joints"] = Json::array();
  for (const StiffenJoint& j : s.joints)
    json["joints"].push_back({{"name", j.name}, {"type", j.type}, {"kept", j.kept}, {"stated", j.stated}, {"stiffness", j.stiffness}, {"damping", j.damping},
                              {"angular_stiffness", j.angular_stiffness}, {"angular_damping", j.angular_damping}, {"influence", j.influence}});
  json["kept_influence"] = s.kept_influence;
  json["kept_where"] = s.kept_where;
  return json.dump(2) + "\n";
}

Plot stiffen_plot(const Stiffening& s, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.subtitle = s.found ? fmt::format("{} digits agree at {:.0e} N/m", s.request.digits, s.stiffness) : "no stiffness was high enough";
  plot.x_quantity = "Stiffness";
  plot.x_unit = "N/m";
  plot.log_x = true;
  for (const StiffenStep& step : s.steps) plot.x.push_back(step.stiffness);
  Panel peaks{"Peak over its limit", "", {}}, changes{"Change against the step before", "", {}};
  changes.log_y = true;
  for (std::size_t i = 0; i < std::min(kMostShown, s.limits.size()); ++i) {
    Curve peak{s.limits[i].name, "", {}}, change = peak;
    for (const StiffenStep& step : s.steps) {
      peak.y.push_back(s.limits[i].limit != 0 ? step.peaks[i] / s.limits[i].limit : std::nan(""));
      change.y.push_back(std::isnan(step.change) ? std::nan("") : step.changes[i]);
    }
    change.dots = change.joined = peak.dots = peak.joined = true;
    peaks.curves.push_back(std::move(peak));
    changes.curves.push_back(std::move(change));
  }
  plot.panels = {peaks, changes};
  plot.panel_height = 220;
  return plot;
}

}  // namespace pintle
