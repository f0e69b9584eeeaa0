#include "studies/joint_errors.h"

#include <algorithm>
#include <cmath>

#include "integrators/thresholds.h"

namespace pintle {
namespace {


double largest_size(const Trajectory& run, int x, int y) {
  double most = 0;
  for (std::size_t i = 0; i < run.n_rows(); ++i) most = std::max(most, std::hypot(run.at(i, x), y < 0 ? 0 : run.at(i, y)));
  return most;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

double peak_to_peak_of_fast_part(const std::vector<double>& d, std::size_t w) {
  const std::size_t n = d.size();
  if (n < 2) return 0;
  std::vector<double> sum(n + 1, 0.0);  // of the first i
  for (std::size_t i = 0; i < n; ++i) sum[i + 1] = sum[i] + d[i];
  double low = 0, high = 0;
  bool first = true;
  for (std::size_t i = n / 2; i < n; ++i) {
    const std::size_t reach = std::min({w, i, n - 1 - i});
    if (reach == 0) continue;
    const double mean = (sum[i + reach + 1] - sum[i - reach]) / static_cast<double>(2 * reach + 1), fast = d[i] - mean;
    low = first ? fast : std::min(low, fast);
    high = first ? fast : std::max(high, fast);
    first = false;
  }
  return high - low;
}

JointErrors::JointErrors(const Trajectory& truth, double radius) : truth_(truth) {
  double largest = 0, largest_couple = 0;
  for (const LoadSummary& joint : truth.joints) {
    const std::string p = "joint." + joint.name + ".on_" + joint.second_body + ".";
    Joint j{joint.name, truth.column(p + "fx[world]"), truth.column(p + "fy[world]"), truth.column(p + "m[world]"), 0, 0};
    j.peak = std::max(largest_size(truth, j.fx, j.fy), joint.peak);  // the peak of an impact lies between rows
    if (j.couple >= 0) j.peak_couple = std::max(largest_size(truth, j.couple, -1), joint.peak_moment);
    largest = std::max(largest, j.peak);
    largest_couple = std::max(largest_couple, j.peak_couple);
    joints_.push_back(j);
  }
  for (Joint& j : joints_) {
    j.peak = std::max({j.peak, kNegligible * largest, 1e-300});
    j.peak_couple = std::max({j.peak_couple, kNegligible * std::max(largest_couple, largest * radius), 1e-300});
  }
  for (std::size_t i = 0; i < truth.columns.size(); ++i) {
    const std::string& name = truth.columns[i].name;
    if (name.rfind("body.", 0) != 0) continue;
    if (ends_with(name, ".x") || ends_with(name, ".y")) positions_.push_back(static_cast<int>(i));
    if (ends_with(name, ".angle")) angles_.push_back(static_cast<int>(i));
  }
}

JointErrors::Worst JointErrors::force_error(const Trajectory& run) const {
  Worst worst;
  const std::size_t rows = std::min(run.n_rows(), truth_.n_rows());
  for (const Joint& j : joints_)
    for (std::size_t i = 0; i < rows; ++i) {
      const double error = std::hypot(run.at(i, j.fx) - truth_.at(i, j.fx), run.at(i, j.fy) - truth_.at(i, j.fy));
      const double couple = j.couple < 0 ? 0 : std::abs(run.at(i, j.couple) - truth_.at(i, j.couple)) / j.peak_couple;
      const double relative = std::max(error / j.peak, couple);
      if (relative > worst.relative) worst = {relative, error, j.name};
    }
  return worst;
}

double JointErrors::vibration_of(const Trajectory& run, int column, std::size_t half_window) const {
  std::vector<double> d(std::min(run.n_rows(), truth_.n_rows()));
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = run.at(i, column) - truth_.at(i, column);
  return peak_to_peak_of_fast_part(d, half_window);
}

JointErrors::Worst JointErrors::vibration(const Trajectory& run, std::size_t half_window) const {
  Worst worst;
  for (const Joint& j : joints_) {
    const double size = std::max(vibration_of(run, j.fx, half_window), vibration_of(run, j.fy, half_window));
    if (size / j.peak > worst.relative) worst = {size / j.peak, size, j.name};
  }
  return worst;
}

std::array<double, 2> JointErrors::position_errors(const Trajectory& run) const {
  std::array<double, 2> worst{0, 0};
  const std::size_t rows = std::min(run.n_rows(), truth_.n_rows());
  for (std::size_t i = 0; i < rows; ++i) {
    for (const int c : positions_) worst[0] = std::max(worst[0], std::abs(run.at(i, c) - truth_.at(i, c)));
    for (const int c : angles_) worst[1] = std::max(worst[1], std::abs(run.at(i, c) - truth_.at(i, c)));
  }
  return worst;
}

}  // namespace pintle
