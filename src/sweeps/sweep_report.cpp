#include "sweeps/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "integrators/thresholds.h"
#include "results/text_table.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;
using Align = TextTable::Align;

constexpr std::array kStatuses{SampleStatus::kCompleted, SampleStatus::kToleranceNotMet, SampleStatus::kFailed, SampleStatus::kNotAssembled, SampleStatus::kModelError,
                               SampleStatus::kHorizon, SampleStatus::kRunaway, SampleStatus::kEnergyOpen};
constexpr std::size_t kMostJoints = 40, kMostMessages = 5;

std::size_t count_of(const SweepTable& table, SampleStatus status) {
  return static_cast<std::size_t>(std::count(table.status.begin(), table.status.end(), static_cast<std::uint8_t>(status)));
}

// Whether its peaks are those of the whole run; for a chaotic motion they are one random outcome of many.
bool has_peaks(std::uint8_t status) {
  constexpr std::array kWhole{SampleStatus::kCompleted, SampleStatus::kToleranceNotMet, SampleStatus::kHorizon};
  return std::find(kWhole.begin(), kWhole.end(), static_cast<SampleStatus>(status)) != kWhole.end();
}

// Quantile of sorted values, between two of them by linear interpolation: the median of an even number is the mean of the middle two.
double at_share(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  return std::lerp(sorted[below], sorted[std::min(below + 1, sorted.size() - 1)], place - static_cast<double>(below));
}

// The largest peak force over the joints of a sample.
double largest_peak(const SweepTable& table, std::size_t sample) {
  const std::size_t n = table.joints.size();
  double largest = 0;
  for (std::size_t j = 0; j < n; ++j) largest = std::fmax(largest, table.force[sample * n + j]);  // fmax ignores unknown values (NaN)
  return largest;
}

PeakStatistics statistics_of(const SweepTable& table, std::size_t joint) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  PeakStatistics out{table.joints[joint], kNone, kNone, kNone, kNone, 0, 0, kNone};
  std::vector<double> peaks;
  bool chaotic = false;  // in some sample, whose peaks have no error
  const std::size_t n = table.joints.size();
  for (std::size_t i = 0; i < table.n_samples(); ++i) {
    const double peak = table.force[i * n + joint], error = table.error[i * n + joint] / std::max(peak, kNegligible * largest_peak(table, i));
    if (!has_peaks(table.status[i]) || !std::isfinite(peak)) continue;
    peaks.push_back(peak);
    if (!(peak >= out.least)) out.least_sample = i, out.least = std::isnan(out.least) ? peak : std::min(out.least, peak);
    if (!(peak <= out.most)) out.most_sample = i, out.most = peak;
    if (std::isfinite(error) && !(error <= out.worst_error)) out.worst_error = error;
    chaotic = chaotic || static_cast<SampleStatus>(table.status[i]) == SampleStatus::kHorizon;
  }
  if (chaotic) out.worst_error = kNone;
  if (peaks.empty()) return out;
  std::sort(peaks.begin(), peaks.end());
  out.least = peaks.front();
  out.median = at_share(peaks, 0.5);
  out.high = at_share(peaks, 0.95);
  return out;
}

std::string values_text(const SweepTable& table, std::size_t sample) {
  std::string text;
  for (std::size_t k = 0; k < table.paths.size(); ++k)
    text += fmt::format("{}{} = {:.6g}{}{}", k > 0 ? ", " : "", table.paths[k], table.values[sample * table.paths.size() + k], table.units[k].empty() ? "" : " ", table.units[k]);
  return text;
}

std::string known(double x) { return std::isfinite(x) ? engineering(x) : "-"; }

// The first line of a message; also the second, if the first ends with a colon.
std::string start_of(const std::string& message) {
  const std::size_t end = message.find('\n');
  if (end == std::string::npos || end == 0) return message;
  const std::size_t from = message.find_first_not_of(" \n", end);
  const bool goes_on = message[end - 1] == ':', is_located = message[end + 1] == ' ';  // a place in the file, and then what is wrong there
  if (from == std::string::npos || !(goes_on || is_located)) return message.substr(0, end);
  return message.substr(0, end) + (goes_on ? " " : ": ") + message.substr(from, message.find('\n', from) - from);
}

std::string troubles_text(const SweepTable& table) {
  std::string text;
  for (const SampleStatus status : kStatuses)
    if (const std::size_t count = count_of(table, status); status != SampleStatus::kCompleted && count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_text(status));
  if (text.empty()) return {};
  text = fmt::format("\n{} of {} samples did not end as \"completed\": {}\n", table.troubled.size(), table.n_samples(), text);
  for (std::size_t k = 0; k < std::min(kMostMessages, table.troubled.size()); ++k) {
    const std::string& message = table.messages[k];
    text += fmt::format("  sample {} ({}): {}\n", table.troubled[k], values_text(table, table.troubled[k]), start_of(message));
  }
  if (table.troubled.size() > kMostMessages) text += "  ... the others are in /troubled of the file\n";
  return text;
}

}  // namespace

std::vector<PeakStatistics> peak_statistics(const SweepTable& table) {
  std::vector<PeakStatistics> out;
  for (std::size_t j = 0; j < table.joints.size(); ++j) out.push_back(statistics_of(table, j));
  return out;
}

std::string sweep_text(const SweepTable& table, bool colour) {
  std::string text = fmt::format("{}\n{} samples of {}\n\nPeak force over the samples\n", table.title, table.n_samples(), fmt::join(table.paths, ", "));
  std::vector<PeakStatistics> joints = peak_statistics(table);
  const bool cut = joints.size() > kMostJoints;
  if (cut) {
    std::stable_sort(joints.begin(), joints.end(), [](const auto& a, const auto& b) { return a.most > b.most; });
    joints.resize(kMostJoints);
  }
  TextTable out;
  out.add_column("joint", Align::kLeft);
  for (const char* head : {"least", "median", "95 %", "most"}) out.add_column(head, Align::kNumber, "N");
  out.add_column("in sample", Align::kNumber);
  out.add_column("error est.", Align::kNumber, "-");
  for (const PeakStatistics& j : joints)
    out.add_row({j.joint, known(j.least), known(j.median), known(j.high), known(j.most), std::isfinite(j.most) ? fmt::format("{}", j.most_sample) : "-",
                 std::isfinite(j.worst_error) ? exponent(j.worst_error) : "-"});
  text += out.text(colour ? "\x1b[1m" : "", colour ? "\x1b[0m" : "");
  if (cut) text += fmt::format("  ... and {} joints with smaller forces; the file has all of them\n", table.joints.size() - kMostJoints);
  std::set<std::size_t> told;
  for (const PeakStatistics& j : joints)
    if (std::isfinite(j.most) && told.size() < kMostMessages && told.insert(j.most_sample).second) text += fmt::format("  sample {}: {}\n", j.most_sample, values_text(table, j.most_sample));
  return text + troubles_text(table);
}

std::string sweep_json(const SweepTable& table, const std::string& file) {
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  Json out = {{"pintle_sweep", 1}, {"model", table.model_name}, {"file", file}, {"plan", table.plan}, {"samples", table.n_samples()}};
  for (const SampleStatus status : kStatuses) out["status"][to_text(status)] = count_of(table, status);
  for (std::size_t k = 0; k < table.paths.size(); ++k) out["values"].push_back({{"path", table.paths[k]}, {"unit", table.units[k]}});
  for (const PeakStatistics& j : peak_statistics(table))
    out["joints"].push_back({{"name", j.joint}, {"unit", "N"}, {"least", number(j.least)}, {"median", number(j.median)}, {"percentile_95", number(j.high)},
                             {"most", number(j.most)}, {"least_sample", j.least_sample}, {"most_sample", j.most_sample}, {"relative_error_estimate", number(j.worst_error)}});
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Plot> sweep_plot(const SweepTable& table) {
  const std::size_t n_paths = table.paths.size(), n_joints = table.joints.size();
  if (n_paths < 1 || n_paths > 2 || table.n_samples() < 2) return std::nullopt;
  std::array<std::set<double>, 2> seen;
  for (std::size_t i = 0; i < table.values.size(); ++i) seen[i % n_paths].insert(table.values[i]);
  const std::size_t x = n_paths == 2 && seen[1].size() > seen[0].size() ? 1 : 0, other = 1 - x;
  constexpr std::size_t kMostCurves = 8, kMostPanels = 6;
  if (n_paths == 2 && seen[other].size() > kMostCurves) return std::nullopt;
  const auto value = [&](std::size_t sample, std::size_t path) { return table.values[sample * n_paths + path]; };
  std::vector<std::size_t> order(table.n_samples());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return value(a, x) < value(b, x); });
  const double least = *seen[x].begin(), most = *seen[x].rbegin();
  const auto panel = [&](const std::string& quantity) {
    Panel out{quantity, "N", {}};
    out.x_quantity = table.paths[x];
    out.x_unit = table.units[x];
    out.log_x = least > 0 && most > 20 * least;
    return out;
  };
  const auto curve = [&](std::size_t joint, std::string label, double of) {
    Curve out{std::move(label), "", {}};
    out.joined = out.dots = table.n_samples() <= 200;
    for (const std::size_t i : order) {
      if (n_paths == 2 && value(i, other) != of) continue;
      out.x.push_back(value(i, x));
      out.y.push_back(table.force[i * n_joints + joint]);
    }
    return out;
  };
  Plot plot;
  plot.title = table.title;
  plot.subtitle = "Peak of each joint's force over the run";
  if (n_paths == 2) plot.subtitle += ", one curve for each value of " + table.paths[other];
  if (n_paths == 1) plot.panels.push_back(panel("Peak force"));
  for (std::size_t j = 0; j < std::min(n_joints, n_paths == 1 ? kMostCurves : kMostPanels); ++j) {
    if (n_paths == 1) {
      plot.panels[0].curves.push_back(curve(j, table.joints[j], 0));
      continue;
    }
    plot.panels.push_back(panel("Peak force, " + table.joints[j]));
    for (const double of : seen[other]) plot.panels.back().curves.push_back(curve(j, fmt::format("{:.4g} {}", of, table.units[other]), of));
  }
  return plot;
}

}  // namespace pintle
