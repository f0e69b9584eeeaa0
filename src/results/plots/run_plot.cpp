#include "results/plots/run_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <string_view>

#include "results/plots/plot_ticks.h"
#include "results/text_table.h"

namespace pintle {
namespace {

struct ComponentName {
  std::string_view word;    // on the command line
  std::string_view column;  // end of the column's name; empty: made from x and y
  const char* label;
  const char* subscript;
};
constexpr std::array<ComponentName, 6> kComponents{{
    {"x", "fx[world]", "F", "x"},
    {"y", "fy[world]", "F", "y"},
    {"magnitude", "", "|F|", ""},
    {"1", "f1[joint]", "F", "1"},
    {"2", "f2[joint]", "F", "2"},
    {"moment", "m[world]", "M", ""},
}};

const ComponentName& find_component(const std::string& word) {
  std::vector<std::string> words;
  for (const ComponentName& component : kComponents) {
    if (component.word == word) return component;
    words.emplace_back(component.word);
  }
  throw PlotRequestError(fmt::format("found component \"{}\": there is no such component.\n    {}", word,
                                     hint_of(word, words, "Components")));
}

std::string body_on(const LoadSummary& joint, const PlotRequest& request) {
  if (request.on.empty()) return joint.second_body;
  if (request.on == joint.first_body || request.on == joint.second_body) return request.on;
  throw PlotRequestError(fmt::format("found body \"{}\": joint {} joins {} and {}.\n    Choose one of these with --on.",
                                     request.on, joint.name, joint.first_body, joint.second_body));
}

constexpr std::size_t kMostJoints = 7;  // plotted without being requested: one colour for each

/// The most loaded joints among those with recorded forces, in the order of the model.
std::vector<std::string> most_loaded_joints(const Trajectory& trajectory) {
  std::vector<const LoadSummary*> joints;
  std::vector<double> peaks;
  for (const LoadSummary& joint : trajectory.joints) {
    const std::string column = fmt::format("joint.{}.on_{}.fx[world]", joint.name, joint.second_body);
    if (std::none_of(trajectory.columns.begin(), trajectory.columns.end(), [&](const Column& c) { return c.name == column; })) continue;
    joints.push_back(&joint);
    peaks.push_back(joint.peak);
  }
  std::sort(peaks.begin(), peaks.end(), std::greater<>());
  const double least = peaks.size() > kMostJoints ? peaks[kMostJoints - 1] : 0;
  std::vector<std::string> names;
  for (const LoadSummary* joint : joints)
    if (joint->peak >= least && names.size() < kMostJoints) names.push_back(joint->name);
  return names;
}

constexpr double kNearRow = 1e-6;  // as a fraction of the period: a row this close to a time of the section counts as at that time
constexpr int kRowsOfPeriod = 100; // suggested number

class PlotMaker {
 public:
  PlotMaker(const RunRecord& run, const PlotRequest& request) : run_(run), request_(request) {}

  Plot make() {
    choose_rows();
    add_x();
    for (const std::string& joint : request_.joints) add_joint(find_joint(run_.trajectory, joint));
    for (const std::string& column : request_.columns) add_column(column);
    if (plot_.panels.empty()) throw PlotRequestError("found nothing to plot.\n    Choose columns with --column.");
    plot_.title = request_.title.empty() ? made_title() : request_.title;
    plot_.subtitle = subtitle();
    if (plot_.title.empty()) std::swap(plot_.title, plot_.subtitle);
    if (plot_.panels.size() > 1) plot_.panel_height = 200;
    if (is_section())
      for (Panel& panel : plot_.panels)
        for (Curve& curve : panel.curves) curve.dots = true;
    return std::move(plot_);
  }

 private:
  bool is_section() const { return request_.every != 0; }

  // All rows, or those one period apart.
  void choose_rows() {
    const std::vector<double> t = values_of(run_.trajectory, 0);
    for (std::size_t row = 0; row < t.size() && !is_section(); ++row) rows_.push_back(row);
    if (!is_section()) return;
    if (!(request_.every > 0) || !std::isfinite(request_.from)) throw PlotRequestError(fmt::format("found --every {:g}: a period in seconds is expected.\n    Choose one above 0.", request_.every));
    for (std::size_t period = 0; !t.empty(); ++period) {
      const double wanted = request_.from + static_cast<double>(period) * request_.every, near = kNearRow * request_.every;
      if (wanted > t.back() + near) break;
      const auto row = std::lower_bound(t.begin(), t.end(), wanted - near);
      if (row == t.end() || *row > wanted + near)
        throw PlotRequestError(fmt::format("found no row at t = {:.9g} s, one of the times {:.9g} s apart.\n    Run again with an output_step that divides the period, such as --set simulate.output_step={:.9g}.",
                                           wanted, request_.every, request_.every / kRowsOfPeriod));
      rows_.push_back(static_cast<std::size_t>(row - t.begin()));
    }
    if (rows_.empty()) throw PlotRequestError(fmt::format("found --from {:g}: the run ends before it, at {:g} s.\n    Choose an earlier time.", request_.from, t.empty() ? 0 : t.back()));
  }

  std::vector<double> values(int column) const {
    const std::vector<double> all = values_of(run_.trajectory, column);
    std::vector<double> chosen;
    for (const std::size_t row : rows_) chosen.push_back(all[row]);
    return chosen;
  }

  void add_x() {
    const int column = find_column(run_.trajectory, request_.x);
    const Column& about = run_.trajectory.columns[static_cast<std::size_t>(column)];
    plot_.x = values(column);
    plot_.x_unit = about.unit;
    plot_.x_quantity = about.name == "t" ? "Time" : about.name;
  }

  Panel& panel_for(const std::string& unit, const std::string& quantity) {
    for (Panel& panel : plot_.panels)
      if (panel.unit == unit) return panel;
    plot_.panels.push_back({quantity, unit, {}});
    return plot_.panels.back();
  }

  void add_joint(const LoadSummary& joint) {
    const std::string body = body_on(joint, request_);
    const std::string prefix = fmt::format("joint.{}.on_{}.", joint.name, body);
    const bool alone = request_.joints.size() == 1;
    const auto column = [&](std::string_view name) {
      return values(find_column(run_.trajectory, prefix + std::string(name)));
    };
    for (const std::string& word : request_.components) {
      const ComponentName& component = find_component(word);
      const bool moment = component.word == "moment";
      const std::string on = alone ? " on " + body : "";
      Curve curve{
          (alone ? "" : fmt::format("{} on {}: ", joint.name, body)) + component.label, component.subscript, {}};
      curve.y =
          component.column.empty() ? magnitude(column("fx[world]"), column("fy[world]")) : column(component.column);
      curve.band = moment ? joint.moment_error_estimate : joint.error_estimate;
      if (component.column.empty() && plot_.x_quantity == "Time" && !is_section()) mark_peak(curve, joint);
      panel_for(moment ? "N*m" : "N", moment ? "Couple" + on : "Force" + on + axes())
          .curves.push_back(std::move(curve));
    }
  }

  /// The line extends to the peak, which is seldom in a row.
  void mark_peak(Curve& curve, const LoadSummary& joint) const {
    curve.mark = Mark{joint.peak_time, joint.peak, fmt::format("peak {:.5g} N at {:.5g} s", joint.peak, joint.peak_time)};
    const auto after = std::upper_bound(plot_.x.begin(), plot_.x.end(), joint.peak_time);
    if (after == plot_.x.begin() || after == plot_.x.end() || *(after - 1) == joint.peak_time) return;
    const auto place = after - plot_.x.begin();
    curve.x = plot_.x;
    curve.x.insert(curve.x.begin() + place, joint.peak_time);
    curve.y.insert(curve.y.begin() + place, joint.peak);
  }

  /// The axes of the force components, if they are all of one kind.
  std::string axes() const {
    const auto any_of = [this](std::initializer_list<std::string_view> words) {
      return std::any_of(request_.components.begin(), request_.components.end(), [&](const std::string& component) {
        return std::find(words.begin(), words.end(), component) != words.end();
      });
    };
    const bool world = any_of({"x", "y"}), joint = any_of({"1", "2"});
    return world == joint ? "" : world ? ", world axes" : ", joint axes";
  }

  void add_column(const std::string& name) {
    const int column = find_column(run_.trajectory, name);
    const std::string& unit = run_.trajectory.columns[static_cast<std::size_t>(column)].unit;
    Panel& panel = panel_for(unit, name);
    if (!panel.curves.empty() && panel.quantity == panel.curves.front().label) panel.quantity = "Value";
    panel.curves.push_back({name, "", values(column)});
  }

  std::string made_title() const {
    if (request_.joints.size() == 1) {
      const LoadSummary& joint = find_joint(run_.trajectory, request_.joints.front());
      return fmt::format("Joint {}: force on {}", joint.name, body_on(joint, request_));
    }
    if (request_.joints.size() > 1) return "Joint forces" + (request_.on.empty() ? "" : " on " + request_.on);
    return request_.columns.size() == 1 ? request_.columns.front() : "";
  }

  /// The model, and for joint forces their accuracy.
  std::string subtitle() const {
    std::string text = run_.stamp.model_name.empty() ? run_.stamp.model_path : run_.stamp.model_name;
    double worst = 0, horizon = run_.trajectory.t_end;
    for (const std::string& name : request_.joints) {
      const LoadSummary& joint = find_joint(run_.trajectory, name);
      worst = std::max(worst, joint.relative_error_estimate);
      horizon = std::min(horizon, joint.horizon);
    }
    const bool chaotic = run_.trajectory.outcome == Outcome::kHorizon && !request_.joints.empty();
    if (is_section()) text += fmt::format("{}every {:.6g} s from {:.6g} s: {} points", text.empty() ? "" : " – ", request_.every, request_.from, rows_.size());
    if (worst > 0) text += fmt::format("{}estimated error {} of the peak", text.empty() ? "" : " – ", printed_number(exponent(worst)));
    if (chaotic) text += fmt::format("{}up to t = {:.4g} s, where the promise ends", text.empty() ? "" : worst > 0 ? " " : " – ", horizon);
    return text;
  }

  const RunRecord& run_;
  const PlotRequest& request_;
  Plot plot_;
  std::vector<std::size_t> rows_;  // rows of the run that are in the plot
};

}  // namespace

Plot make_plot(const RunRecord& run, const PlotRequest& request) {
  if (!request.joints.empty() || !request.columns.empty()) return PlotMaker(run, request).make();
  PlotRequest all = request;
  all.joints = most_loaded_joints(run.trajectory);
  if (all.joints.size() > 1) all.components = {"magnitude"};
  const auto has_couples_alone = [&run](const std::string& name) { return find_joint(run.trajectory, name).peak == 0 && find_joint(run.trajectory, name).peak_moment > 0; };
  if (!all.joints.empty() && std::all_of(all.joints.begin(), all.joints.end(), has_couples_alone)) all.components = {"moment"};
  return PlotMaker(run, all).make();
}

Plot overlay(const std::vector<NamedPlot>& plots) {
  constexpr int kSolid = 7;  // number of styles before they repeat with dashes
  Plot all = plots.front().plot;
  all.subtitle.clear();
  for (const NamedPlot& one : plots) all.subtitle += (all.subtitle.empty() ? "" : ", ") + one.name;
  all.panels.clear();
  for (std::size_t run = 0; run < plots.size(); ++run) {
    const Plot& plot = plots[run].plot;
    for (const Panel& from : plot.panels) {
      const auto same_unit = [&from](const Panel& panel) { return panel.unit == from.unit; };
      auto panel = std::find_if(all.panels.begin(), all.panels.end(), same_unit);
      if (panel == all.panels.end()) {
        panel = all.panels.insert(panel, from);
        panel->x_quantity = all.x_quantity;
        panel->x_unit = all.x_unit;
        panel->curves.clear();
      }
      for (std::size_t i = 0; i < from.curves.size(); ++i) {
        Curve curve = from.curves[i];
        curve.label = fmt::format("{}: {}{}", plots[run].name, curve.label, from.quantity == panel->quantity ? "" : " (" + from.quantity + ")");
        if (curve.x.empty()) curve.x = plot.x;
        curve.style = static_cast<int>(i) % kSolid + kSolid * static_cast<int>(run);
        panel->curves.push_back(std::move(curve));
      }
    }
  }
  return all;
}

}  // namespace pintle
