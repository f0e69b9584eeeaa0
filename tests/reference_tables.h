// Known solutions, tests/reference/*.csv, and runs to compare with them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pintle/read_model.h"
#include "pintle/simulate.h"
#include "run/integration.h"
#include "run/pass_constants.h"
#include "run/recorder.h"
#include "start/start.h"

namespace pintle::reference {

/// A table with named columns.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  double at(std::size_t row, const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::logic_error("no column " + name);
    return rows.at(row)[static_cast<std::size_t>(found - names.begin())];
  }
  double peak(const std::string& name) const {
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) largest = std::max(largest, std::abs(at(i, name)));
    return largest;
  }
  double peak(const std::string& x, const std::string& y) const {
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) largest = std::max(largest, std::hypot(at(i, x), at(i, y)));
    return largest;
  }
};

inline Table read_table(const std::string& name) {
  std::ifstream in(std::string(PINTLE_SOURCE_DIR) + "/tests/reference/" + name + ".csv");
  Table table;
  std::string line, cell;
  while (std::getline(in, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    if (table.names.empty()) {
      while (std::getline(cells, cell, ',')) table.names.push_back(cell);
      continue;
    }
    table.rows.emplace_back();
    while (std::getline(cells, cell, ',')) table.rows.back().push_back(std::stod(cell));
    if (table.rows.back().size() != table.names.size()) throw std::logic_error(name + ": " + line);
  }
  if (table.rows.empty()) throw std::logic_error("no table " + name);
  return table;
}

/// A mechanism of the collection.
inline Model mechanism(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_model(std::string(PINTLE_SOURCE_DIR) + "/mechanisms/" + name + ".toml", overrides);
}

/// A model kept in tests/models because it once broke a promise.
inline Model test_model(const std::string& name, const std::vector<std::string>& overrides = {}) { return read_model(std::string(PINTLE_SOURCE_DIR) + "/tests/models/" + name + ".toml", overrides); }

/// The four-bar of section 8 of the paper with friction in all pins.
inline Model rubbing_four_bar() {
  Model model = mechanism("four_bar");
  for (Joint& joint : model.joints) joint.friction = {"lugre", {{"pin_radius", {0.01}}}};
  return model;
}

inline void set_joints(Model& model, double stiffness, double damping) {
  for (Joint& joint : model.joints) {
    joint.law.values["stiffness"] = {stiffness};
    joint.law.values["damping"] = {damping};
  }
}

inline double value(const Trajectory& run, std::size_t row, const std::string& column) {
  const int c = run.column(column);
  if (c < 0) throw std::logic_error("no column " + column);
  return run.at(row, static_cast<std::size_t>(c));
}

inline double at_end(const Trajectory& run, const std::string& column) { return value(run, run.n_rows() - 1, column); }

inline Trajectory completed(const Model& model) {
  Trajectory run = simulate(model);
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  return run;
}

/// Drift of the energy account, relative to the energies that a run has turned over.
inline double drift(const Trajectory& run) { return run.energy.drift / (run.energy.kinetic_peak + run.energy.dissipated + std::abs(run.energy.supplied)); }

/// A mass of 1 kg on a slide, pulled by a spring of 2 N/m whose far end moves at 0.1 m/s; it sticks and slips with the friction stated by `friction`.
inline std::string pulled_mass(double gravity, const std::string& friction, double mass = 1, double stiffness = 2, double speed = 0.1) {
  const auto number = [](double x) { return std::to_string(x); };
  return "format = 1\ngravity = [0, " + number(-gravity) + "]" + R"toml(
[simulate]
duration = "25 s"
output_step = "0.5 s"
[ground.markers]
o = [0, 0]
[body.mass]
inertia = 0.01
markers.c = [0, 0]
mass = )toml" + number(mass) + R"toml(
[motor.pull]
joint = "slide"
force = ")toml" + number(stiffness) + " N/m*(" + number(speed) + R"toml( m/s*t - slide)"
[joint.slide]
type = "prismatic"
between = ["ground.o", "mass.c"]
)toml" + friction;
}

/// A shaft of 1 kg that a load of 400 N presses down into a bush, 0.1 mm larger in radius than its pin of 12 mm; `motor` turns it.
inline Model shaft_in_bush(double friction, double spin, const std::string& motor, double duration) {
  return parse_model(R"toml(
format = 1
gravity = [0, 0]
[simulate]
start = "seated"
duration = )toml" + std::to_string(duration) + R"toml(
[ground.markers]
b = [0, 0]
[body.shaft]
mass = 1
inertia = 1e-3
position = [0, 0]
angle = 0
hold = ["angle"]
markers.c = [0, 0]
spin = )toml" + std::to_string(spin) + R"toml(
[force.P]
on = "shaft.c"
force = [0, -400]
[motor.m]
joint = "J"
)toml" + motor + R"toml(
[joint.J]
type = "revolute"
between = ["ground.b", "shaft.c"]
law = "clearance"
clearance = "0.1 mm"
pin_radius = "12 mm"
restitution = 0.3
friction_coefficient = )toml" + std::to_string(friction), "shaft.toml");
}

/// The row of time t.
inline std::size_t row_at(const Trajectory& run, double t) {
  for (std::size_t i = 0; i < run.n_rows(); ++i)
    if (std::abs(run.at(i, 0) - t) < 1e-9 * std::max(1.0, t)) return i;
  throw std::logic_error("no row at t = " + std::to_string(t));
}

/// How far the force columns `joint`.fx, .fy[world] are from (x, y).
inline double force_error(const Trajectory& run, std::size_t row, const std::string& joint, double x, double y) {
  return std::hypot(value(run, row, "joint." + joint + ".fx[world]") - x, value(run, row, "joint." + joint + ".fy[world]") - y);
}

/// A point of a body and how it moves, the body's angle and spin [m, m, m/s, m/s, rad, rad/s].
struct PointMotion {
  double x, y, vx, vy, angle, omega;
};
/// Allowed differences [m, rad, m/s, rad/s].
struct Limits {
  double position, angle, velocity, spin;
};

/// Checks the centre of mass and the motion of a body whose point (px, py), in its own axes, moves as `point` says.
inline void expect_body(const Trajectory& run, std::size_t row, const std::string& name, const PointMotion& point, double px, double py,
                        const Limits& limits) {
  const double c = std::cos(point.angle), s = std::sin(point.angle), dx = -(c * px - s * py), dy = -(s * px + c * py);
  const std::string body = "body." + name + ".";
  EXPECT_NEAR(value(run, row, body + "x"), point.x + dx, limits.position) << name << " " << row;
  EXPECT_NEAR(value(run, row, body + "y"), point.y + dy, limits.position) << name << " " << row;
  EXPECT_NEAR(value(run, row, body + "angle"), point.angle, limits.angle) << name << " " << row;
  EXPECT_NEAR(value(run, row, body + "vx"), point.vx - point.omega * dy, limits.velocity) << name << " " << row;
  EXPECT_NEAR(value(run, row, body + "vy"), point.vy + point.omega * dx, limits.velocity) << name << " " << row;
  EXPECT_NEAR(value(run, row, body + "spin"), point.omega, limits.spin) << name << " " << row;
}

/// One integration of the model from its start; `stages` 0: the explicit method.
inline Integration integrate_once(const Model& model, double tolerance, int stages, const LoadScale* scale, Trajectory* out = nullptr) {
  const Assembly assembly = start_of_run(model);
  const System& system = assembly.system;
  const State& start = assembly.state;
  IntegrationPlan plan;
  plan.duration = model.simulate.duration;
  plan.output_step = model.simulate.output_step > 0 ? model.simulate.output_step : plan.duration / 500;
  plan.max_step = model.simulate.max_step;
  plan.tolerance = tolerance;
  plan.first_step = 1e-4 * plan.duration;
  plan.choice = {model.simulate.equations, stages == 0 ? "dopri5" : "radau", stages};
  plan.scale = scale;
  Recorder recorder(model, system);
  Integration done = integrate(system, start, plan, recorder);
  if (out) recorder.fill(*out);
  return done;
}

/// Counters of the second, reported pass of a run, after a pilot with ten times the tolerance; five stages where the pilot's Newton iterations show that its
/// steps are short.
inline Counters reported_pass(const Model& model) {
  Integration pilot = integrate_once(model, kPilot * model.simulate.tolerance, 3, nullptr);
  const Counters& c = pilot.counters;
  const int stages = static_cast<double>(c.newton_iterations) < kEasy * static_cast<double>(c.steps) ? 5 : 3;
  if (stages == 5) pilot = integrate_once(model, kPilot * model.simulate.tolerance, stages, nullptr);
  return integrate_once(model, model.simulate.tolerance, stages, &pilot.scale).counters;
}

}  // namespace pintle::reference
