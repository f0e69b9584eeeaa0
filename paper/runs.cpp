#include "paper/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "pintle/read_model.h"
#include "pintle/results.h"
#include "pintle/simulate.h"
#include "run/integration.h"
#include "run/recorder.h"
#include "start/start.h"

namespace pintle::paper {
namespace {

constexpr long kMostSteps = 1000000;  // of one integration

}  // namespace

Model mechanism(const std::string& name, const std::vector<std::string>& overrides) {
  return read_model(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/" + name + ".toml", overrides);
}

void set_bearings(Model& model, const Bearing& bearing) {
  for (Joint& joint : model.joints) {
    joint.law.values["stiffness"] = {bearing.k};
    joint.law.values["damping"] = {bearing.c};
  }
}

Trajectory run(const Model& model, bool tolerance_may_fail) {
  Trajectory result = simulate(model);
  const bool usable = tolerance_may_fail && result.outcome == Outcome::kToleranceNotMet;
  if (result.outcome != Outcome::kCompleted && !usable)
    throw std::runtime_error(fmt::format("{}: {} {}", model.name, to_text(result.outcome), result.message));
  return result;
}

SingleRun run_once(const Model& model, const std::string& method, double tolerance, double max_step) {
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  IntegrationPlan plan;
  plan.duration = model.simulate.duration;
  plan.output_step = model.simulate.output_step;
  plan.max_step = max_step;
  plan.tolerance = tolerance;
  plan.first_step = 1e-4 * plan.duration;
  if (max_step > 0) plan.first_step = std::min(plan.first_step, max_step);
  plan.choice.equations = model.simulate.equations;
  plan.choice.method = method;
  long steps = 0;
  plan.keep_going = [&steps](double) { return ++steps < kMostSteps; };
  Recorder recorder(model, system);
  const Integration done = integrate(system, start, plan, recorder);
  SingleRun result;
  recorder.fill(result.trajectory);
  result.trajectory.counters = done.counters;
  result.completed = done.ended == Ended::kAtEnd;
  result.message = done.ended == Ended::kStopped ? fmt::format("given up after {} steps", steps) : done.message;
  return result;
}

std::vector<double> column(const Trajectory& run, const std::string& name) {
  const int c = run.column(name);
  if (c < 0) throw std::logic_error("no column " + name);
  std::vector<double> out(run.n_rows());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = run.at(i, static_cast<std::size_t>(c));
  return out;
}

std::vector<double> distance(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(std::min(a.size(), b.size()));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::abs(a[i] - b[i]);
  return out;
}

double largest(const std::vector<double>& x) {
  double result = 0;
  for (const double value : x) result = std::max(result, std::abs(value));
  return result;
}

double digits(double relative) {
  return -std::log10(std::max(relative, 1e-16));
}

std::string short_number(double x) {
  if (x == 0) return "0";
  if (std::abs(x) >= 1 && std::abs(x) < 1e4) return fmt::format("{:g}", x);
  std::string text = fmt::format("{:.2g}", x);
  if (text.find('e') == std::string::npos) text = fmt::format("{:.0e}", x);
  for (const char* zero : {"e+0", "e+", "e-0"}) {
    const std::size_t at = text.find(zero);
    if (at == std::string::npos) continue;
    text.replace(at, std::string(zero).size(), zero[1] == '-' ? "e-" : "e");
    break;
  }
  return text;
}

ReferenceTable::ReferenceTable(const std::string& name) {
  std::ifstream in(std::string(PINTLE_SOURCE_DIR) + "/tests/reference/" + name + ".csv");
  std::string line, cell;
  while (std::getline(in, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    if (names_.empty()) {
      while (std::getline(cells, cell, ',')) names_.push_back(cell);
      continue;
    }
    rows_.emplace_back();
    while (std::getline(cells, cell, ',')) rows_.back().push_back(std::stod(cell));
  }
  if (rows_.empty()) throw std::runtime_error("no table " + name);
}

double ReferenceTable::at(std::size_t row, const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) throw std::logic_error("no column " + name);
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

}  // namespace pintle::paper
