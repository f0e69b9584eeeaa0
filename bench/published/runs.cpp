#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "bench/published/benchmarks.h"
#include "pintle/read_model.h"
#include "pintle/results.h"
#include "pintle/simulate.h"

namespace pintle::published {

nlohmann::json read_facts(const std::string& name) {
  const std::string path = std::string(PINTLE_SOURCE_DIR) + "/bench/published/" + name + ".json";
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return nlohmann::json::parse(file);
}

Model model_of(const std::string& name, const std::vector<std::string>& overrides) {
  const std::string folder = name.find('/') == std::string::npos ? "/mechanisms/" : "/";
  return read_model(PINTLE_SOURCE_DIR + folder + name + ".toml", overrides);
}

void set_joints(Model& model, double stiffness, double damping) {
  for (Joint& joint : model.joints) {
    joint.law.values["stiffness"] = {stiffness};
    joint.law.values["damping"] = {damping};
  }
}

bool run(Model model, bool ideal, Report& report, Trajectory& out) {
  if (ideal && !has_constraints(model.simulate.equations)) model.simulate.equations = Equations::kIdeal;
  try {
    out = simulate(model);
  } catch (const std::invalid_argument& error) {
    if (!ideal) throw;
    report.skipped.push_back(fmt::format("{} with {} equations: {}", model.name, to_word(model.simulate.equations), error.what()));
    return false;
  }
  if (out.outcome == Outcome::kFailed || out.outcome == Outcome::kInterrupted) {
    if (!ideal) throw std::runtime_error(model.name + ": " + out.message);
    report.skipped.push_back(fmt::format("{} with {} equations: {}", model.name, to_word(model.simulate.equations), out.message));
    return false;
  }
  return true;
}

std::string joints_text(double stiffness, bool ideal) {
  return ideal ? "ideal" : fmt::format("k = {:.0e} N/m", stiffness);
}

double value(const Trajectory& run, std::size_t row, const std::string& column) {
  const int c = run.column(column);
  if (c < 0) throw std::logic_error("no column " + column);
  return run.at(row, static_cast<std::size_t>(c));
}

long row_at(const Trajectory& run, double t) {
  std::size_t low = 0, high = run.n_rows();
  while (low + 1 < high) {
    const std::size_t middle = (low + high) / 2;
    (run.at(middle, 0) <= t * (1 + 1e-12) + 1e-12 ? low : high) = middle;
  }
  return std::abs(run.at(low, 0) - t) < 1e-9 * std::max(1.0, t) ? static_cast<long>(low) : -1;
}

double energy_error(const Trajectory& run) {
  const auto total = [&](std::size_t row) {
    return value(run, row, "energy.kinetic") + value(run, row, "energy.potential") - value(run, row, "energy.supplied");
  };
  double largest = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) largest = std::max(largest, std::abs(total(row) - total(0)));
  return largest;
}

double point_error(const Trajectory& run, const nlohmann::json& rows, const std::string& body, double scale, double until) {
  double largest = 0;
  int found = 0;
  for (const auto& at : rows) {
    const double t = at[0];
    const long row = t <= until ? row_at(run, t) : -1;
    if (row < 0) continue;
    ++found;
    const auto i = static_cast<std::size_t>(row);
    largest = std::max({largest, std::abs(scale * value(run, i, body + ".x") - at[1].get<double>()),
                        std::abs(scale * value(run, i, body + ".y") - at[2].get<double>())});
  }
  return found > 1 ? largest : NAN;
}

}  // namespace pintle::published
