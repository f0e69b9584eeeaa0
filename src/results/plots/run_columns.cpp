#include "results/plots/run_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "base/text/did_you_mean.h"
#include "results/plots/plot_ticks.h"

namespace pintle {
namespace {

// Of many names, those that share the most leading parts with the word: for "joint.A.fz" those that begin with "joint.A.".
std::vector<std::string> closest_family(const std::string& word, const std::vector<std::string>& names) {
  std::vector<std::string> family = names;
  for (std::size_t dot = word.find('.'); dot != std::string::npos; dot = word.find('.', dot + 1)) {
    const std::string prefix = word.substr(0, dot + 1);
    std::vector<std::string> closer;
    std::copy_if(family.begin(), family.end(), std::back_inserter(closer), [&](const std::string& name) { return name.starts_with(prefix); });
    if (closer.empty()) break;
    family = std::move(closer);
  }
  return family;
}

}  // namespace

std::string hint_of(const std::string& word, const std::vector<std::string>& words, std::string_view list_name) {
  constexpr std::size_t kMost = 30;
  if (const auto meant = did_you_mean(word, words)) return fmt::format("Did you mean \"{}\"?", *meant);
  const std::vector<std::string> family = closest_family(word, words);
  const std::span<const std::string> shown = std::span(family).first(std::min(kMost, family.size()));
  const std::string rest = family.size() > kMost ? fmt::format(", and {} more", family.size() - kMost) : "";
  return fmt::format("{}{}: {}{}.", list_name, family.size() < words.size() ? " of this kind" : "", family.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", ")), rest);
}

std::vector<double> values_of(const Trajectory& trajectory, int column) {
  std::vector<double> values(trajectory.n_rows());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = trajectory.at(i, static_cast<std::size_t>(column));
  return values;
}

int find_column(const Trajectory& trajectory, const std::string& name) {
  const int column = trajectory.column(name);
  if (column >= 0) return column;
  std::vector<std::string> names;
  for (const Column& entry : trajectory.columns) names.push_back(entry.name);
  throw PlotRequestError(
      fmt::format("found column \"{}\": the run has no such column.\n    {}", name, hint_of(name, names, "Its columns")));
}

const LoadSummary& find_joint(const Trajectory& trajectory, const std::string& name) {
  std::vector<std::string> names;
  for (const LoadSummary& joint : trajectory.joints) {
    if (joint.name == name) return joint;
    names.push_back(joint.name);
  }
  throw PlotRequestError(
      fmt::format("found joint \"{}\": the run has no such joint.\n    {}", name, hint_of(name, names, "Its joints")));
}

std::string peak_between_rows(const Trajectory& trajectory, const LoadSummary& joint, double seen) {
  const std::string on = "joint." + joint.name + ".on_" + joint.second_body + ".";
  const int x = trajectory.column(on + "fx[world]"), y = trajectory.column(on + "fy[world]"), z = trajectory.column(on + "fz[world]");
  if (x < 0 || y < 0) return "";
  double largest = 0;
  for (std::size_t i = 0; i < trajectory.n_rows(); ++i) {
    const auto at = [&](int column) { return column < 0 ? 0 : trajectory.at(i, static_cast<std::size_t>(column)); };
    largest = std::max(largest, std::hypot(at(x), at(y), at(z)));
  }
  return largest < seen * joint.peak ? fmt::format("between the rows joint {} reaches {} N", joint.name, printed_number(fmt::format("{:.5g}", joint.peak))) : "";
}

std::vector<double> magnitude(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> result(x.size());
  std::transform(x.begin(), x.end(), y.begin(), result.begin(), [](double a, double b) { return std::hypot(a, b); });
  return result;
}

}  // namespace pintle
