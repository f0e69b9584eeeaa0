// Starts with soft joints: closed forms of one body on a spring, forces of ideal joints, independence of irrelevant
// quantities.
#include "start/start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>

#include "integrators/start_states_for_tests.h"
#include "pintle/simulate.h"
#include "start/slow_manifold.h"

namespace pintle {
namespace {

using sample::DenseEquations;

constexpr double kPushedMass = 2, kSteady = 10, kSwing = 3;  // kg, N, N

// A body pinned at its centre, pushed along x by F(t) = kSteady + kSwing sin(w t).
Model pushed_mass(double k, double c, double w) {
  Model model;
  model.gravity = {0, 0};
  model.ground = {{"O", {0, 0}, 0}};
  model.bodies = {sample::body("block", kPushedMass, 1, {{"O", {0, 0}, 0}})};
  sample::put_at(model.bodies[0], 0, 0, 0);
  model.joints = {sample::joint("pin", "revolute", {"ground", "O"}, {"block", "O"}, k, c)};
  AppliedForce force;
  force.name = "push";
  force.on = {"block", "O"};
  force.force = {sample::expression(std::to_string(kSteady) + " + " + std::to_string(kSwing) + "*sin(" + std::to_string(w) + "*t)"),
                 sample::expression("0")};
  force.torque = sample::expression("0");
  model.forces = {force};
  model.simulate.duration = 1;
  return model;
}

State started(Model model) {
  if (model.simulate.duration == 0) model.simulate.duration = 1;
  return start_of_run(model).state;
}

// A sweep that finds the same gaps as the previous one has converged, and its state is taken.
TEST(Start, SweepsThatRepeatTheirGapsHaveConverged) {
  struct Sweeps {
    std::array<double, 3> change;
    int done = 0;
    double sweep() { return change[static_cast<std::size_t>(done++)]; }
    bool write_start(int& state) const { return state = done, true; }
  };
  Sweeps at_once{{0, 0, 0}}, in_three{{1, 0.1, 0}};
  int state = 0;
  EXPECT_EQ(sweep_onto(at_once, state), 0);
  EXPECT_EQ(state, 0);
  EXPECT_EQ(sweep_onto(in_three, state), 0);
  EXPECT_EQ(state, 3);
}

// The motion without free vibration: x = F0/k + Im F1 / (k - m w^2 + i c w) at t = 0.
TEST(Start, ASpringSlowEnoughStartsOnItsForcedMotion) {
  for (const auto& [k, c] : {std::pair{2e4, 1.0}, {2e4, 100.0}, {2e3, 20.0}}) {
    const double w = 0.1 * std::sqrt(k / kPushedMass);
    const std::complex<double> swing = kSwing / std::complex<double>(k - kPushedMass * w * w, c * w);
    const State state = started(pushed_mass(k, c, w));
    EXPECT_NEAR(k * state.q[0][0], kSteady + k * swing.imag(), 1e-5 * kSteady) << k << " " << c;
    EXPECT_NEAR(k * state.v[0][0] / w, k * swing.real(), 1e-5 * kSteady) << k << " " << c;
  }
}

// Slow compared with its load: it starts at rest with the gap that carries the load.
TEST(Start, ASpringMuchSlowerThanItsLoadStartsAtRestUnderIt) {
  const double k = 200, w = 100 * std::sqrt(k / kPushedMass);
  const State state = started(pushed_mass(k, 0.5, w));
  EXPECT_NEAR(k * state.q[0][0], kSteady, 1e-3 * kSteady);
  EXPECT_NEAR(k * state.v[0][0] / w, 0, 1e-3 * kSteady);
}

// Relaxation k/c no faster than the load: the starting gap is arbitrary, but spring and damper together carry the load.
TEST(Start, AnOverdampedJointCarriesItsLoadFromTheStart) {
  const State state = started(pushed_mass(1e7, 5e5, 10));
  EXPECT_NEAR(-state.force[0][0], kSteady, 1e-5 * kSteady);
  EXPECT_NEAR(-state.force[0][0], 1e7 * state.gap[0][0] + 5e5 * state.gap_rate[0][0], 1e-9);
}

TEST(Start, DoesNotDependOnTheDurationOfTheRun) {
  Model model = pushed_mass(2e3, 20, 5);
  const State one = started(model);
  model.simulate.duration = 0.37;
  const State other = started(model);
  EXPECT_NEAR(one.force[0][0], other.force[0][0], 1e-5 * kSteady);
  EXPECT_NEAR(one.gap_rate[0][0], other.gap_rate[0][0], 1e-5 * kSteady * 5 / 2e3);
}

// Journal bearings deflect by F/k = 60 um: the forces are those of ideal joints, apart from a relative error of 60 um
// over a link's length and the forces that accelerate the gaps.
TEST(Start, JournalBearingsCarryTheForcesOfIdealJoints) {
  Model model = sample::four_bar(1e7, 5e5);
  model.simulate.duration = 1;
  const Assembly start = start_of_run(model);
  const State& state = start.state;
  const DenseEquations e(start.system, 0, state.q, state.v);
  const Eigen::VectorXd ideal = e.reactions();
  const double peak = ideal.cwiseAbs().maxCoeff();
  for (int r = 0; r < ideal.size(); ++r) EXPECT_NEAR(state.force[e.rows[r].first][e.rows[r].second], ideal[r], 1e-3 * peak) << r;
}

Model four_bar_with_soft_b(double others) {
  Model model = sample::four_bar(others, 500);
  auto& values = model.joints[2].law.values;
  values["stiffness"] = {2e5};
  values["damping"] = {3000};
  return model;
}

// The influence of the other joints' stiffness is inversely proportional to it.
TEST(Start, ASoftJointDoesNotAskHowStiffTheOthersAre) {
  const State limit = started(four_bar_with_soft_b(1e12));
  const double force = limit.force[2].head<2>().norm();
  for (const double k : {1e7, 1e8, 1e9, 1e10}) {
    const State state = started(four_bar_with_soft_b(k));
    EXPECT_LT((state.force[2] - limit.force[2]).head<2>().norm(), 1e-3 * force * 1e7 / k + 1e-6 * force) << k;
    EXPECT_LT((state.gap[2] - limit.gap[2]).head<2>().norm(), (1e-3 * 1e7 / k + 1e-6) * limit.gap[2].head<2>().norm()) << k;
  }
}

// Rows every tenth of a millisecond: a smooth force changes evenly, a ringing one does not.
TEST(Start, TheForcesOfSoftJointsRunOnSmoothly) {
  for (Model model : {sample::four_bar(1e7, 5e5), four_bar_with_soft_b(1e8), four_bar_with_soft_b(1e9)}) {
    model.simulate.duration = 2e-3;
    model.simulate.output_step = 1e-4;
    const Trajectory run = simulate(model);
    for (std::size_t c = 0; c < run.columns.size(); ++c) {
      if (run.columns[c].name.find(".on_") == std::string::npos || run.columns[c].name.find("[world]") == std::string::npos) continue;
      double uneven = 0;
      const auto at = [&](std::size_t row) { return run.at(row, static_cast<int>(c)); };
      for (std::size_t row = 1; row + 1 < run.n_rows(); ++row) uneven = std::max(uneven, std::abs(at(row + 1) - 2 * at(row) + at(row - 1)));
      EXPECT_LT(uneven, 0.05) << run.columns[c].name;  // of 600 N
    }
  }
}

// If a force jumps at the start, no start is free of ringing, and the notes say so.
TEST(Start, NotesSayWhatStartsOnItsOwn) {
  const auto notes = [](const Model& model) { return start_of_run(model).notes; };
  const auto mention = [](const std::vector<std::string>& lines, const char* what) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(mention(notes(pushed_mass(200, 0.5, 1000)), "joint pin"));
  EXPECT_FALSE(mention(notes(pushed_mass(2e8, 3000, 10)), "joint pin"));
  Model stiff = sample::four_bar(1e8, 3000);
  stiff.simulate.duration = 1;
  EXPECT_TRUE(notes(stiff).empty());
  Model jumping = pushed_mass(2e8, 3000, 10);
  jumping.forces[0].force[0] = sample::expression("10 + 5*sign(t)");
  EXPECT_TRUE(mention(notes(jumping), "no transient-free start"));
}

}  // namespace
}  // namespace pintle
