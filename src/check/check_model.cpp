// The check as a whole: assembles twice (as unstrained as possible, and under load), then runs each part.
#include <algorithm>

#include "check/check_batteries.h"
#include "check/modes/check_frequencies.h"
#include "check/check_gears.h"
#include "check/modes/check_small_motions.h"
#include "check/check_topology.h"
#include "mobility/mobility.h"
#include "pintle/check.h"
#include "pintle/simulate.h"
#include "start/start.h"

namespace pintle {
namespace {

Assembly assembled(const Model& model, Start start) {
  Model as = model;
  as.simulate.start = start;
  try {
    return assemble(as);
  } catch (const AssemblyError&) {
    if (model.simulate.start != Start::kRaw) throw;
  }
  as.simulate.start = Start::kRaw;  // its gaps are intended
  Assembly out = assemble(as);
  out.notes.push_back("checked at the stated positions, where gaps are wider than after assembly");
  return out;
}

void count(const Model& model, CheckReport& report) {
  report.n_bodies = static_cast<int>(model.bodies.size());
  report.n_joints = static_cast<int>(model.joints.size());
  report.n_springs = static_cast<int>(model.springs.size());
  report.n_forces = static_cast<int>(model.forces.size());
  report.n_motors = static_cast<int>(model.motors.size());
}

void weigh(const Model& model, const Vecs& q, CheckReport& report) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    report.total_mass += model.bodies[i].mass;
    for (const int k : {0, 1}) report.mass_centre[k] += model.bodies[i].mass * q[i][k];
  }
  if (report.total_mass > 0)
    for (double& x : report.mass_centre) x /= report.total_mass;
}

}  // namespace

bool CheckBattery::passed() const {
  return std::all_of(items.begin(), items.end(), [](const CheckItem& item) { return item.passed(); });
}

CheckBattery jacobian_battery(const System& system, const State& assembled, const std::vector<CheckState>& states,
                              double duration) {
  CheckBattery battery;
  check_displacement_slopes(system, states, battery);
  check_law_slopes(system, assembled, states, battery);
  check_load_slopes(system, states, battery);
  check_expressions(system, states, duration, battery);
  check_whole_slopes(system, states, battery);
  return battery;
}

CheckBattery energy_battery(const System& system, const State& assembled, const std::vector<CheckState>& states) {
  CheckBattery battery;
  check_link_forces(system, states, battery);
  check_law_energy(system, assembled, states, battery);
  check_power_account(system, states, battery);
  return battery;
}

CheckReport check_model(const Model& model) {
  CheckReport report;
  count(model, report);
  const bool settles = model.simulate.start == Start::kSettled;  // bodies may start inside each other, and only their position of rest is meaningful
  const Assembly unstrained = settles ? start_of_run(model) : assembled(model, Start::kUnloaded), loaded = settles ? unstrained : assembled(model, Start::kAssembled);
  report.notes = model.notes;
  report.notes.insert(report.notes.end(), loaded.notes.begin(), loaded.notes.end());
  weigh(model, loaded.state.q, report);
  report.topology = check_topology(unstrained.system);
  MobilityCheck mobility = check_mobility(unstrained.system, unstrained.state.q);
  report.mobility = std::move(mobility.counts);
  report.redundancies = std::move(mobility.redundancies);
  report.gears = check_gears(unstrained.system);
  if (!report.gears.empty()) {
    TrainCheck train = check_train(model, unstrained.system, unstrained.state.q, report.mobility);
    report.transmission_of = std::move(train.reference);
    report.transmission = std::move(train.ratios);
  }
  report.frequencies = check_frequencies(loaded.system, loaded.state, report.mobility.mobility_driven);
  report.small_motions = check_small_motions(loaded.system, loaded.state);
  const auto states = check_states(model, loaded.system, loaded.state);
  const double duration = model.simulate.duration > 0 ? model.simulate.duration : 1;
  report.jacobians = jacobian_battery(loaded.system, loaded.state, states, duration);
  report.energy = energy_battery(loaded.system, loaded.state, states);
  return report;
}

}  // namespace pintle
