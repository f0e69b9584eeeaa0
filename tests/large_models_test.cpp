// Mechanisms of thousands of bodies: any cost that is quadratic in their number makes these unbearably slow.
#include "tests/large_models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pintle/simulate.h"
#include "run/recording.h"
#include "start/start.h"
#include "system/build.h"

namespace pintle::sample {
namespace {

TEST(LargeModels, AChainWithoutPositionsIsPutTogether) {
  constexpr int kBars = 20000;
  Model model = chain_model(kBars);
  for (Body& bar : model.bodies) bar.position.reset();
  model.simulate.start = Start::kUnloaded;
  const Assembly assembly = assemble(model);
  for (const int i : {0, 1, 777, kBars - 1}) {
    EXPECT_NEAR(assembly.state.q[i][0], i + 0.5, 1e-6);
    EXPECT_NEAR(assembly.state.q[i][1], 0, 1e-6);
  }
}

// Two hundred loops sway along the ladder more slowly than they swing: the start must not mistake that for a deflection of the joints.
TEST(LargeModels, ALongLadderStartsWithItsSpeeds) {
  const Model model = ladder_model(200);
  const Assembly start = start_of_run(model);
  for (int i = 0; i < start.system.n_bodies(); ++i) EXPECT_NEAR(start.state.v[i][2], model.bodies[i].spin.value(), 1e-4) << start.system.bodies[i].name;
}

// In bars released from level, each bar's end must fall as the beginning of the next one does: F_i + 4 F_i+1 + F_i+2 = 0 and 4 F_0 + 2 F_1 = m g, whose
// solution decays by the factor sqrt(3) - 2 from pin to pin.
TEST(LargeModels, AChainThatIsLetGoHangsOnItsFirstPins) {
  Model model = chain_model(2000);
  model.simulate.duration = 0.01;
  model.simulate.output_step = 0.005;
  model.simulate.record = {"joint.pin0", "joint.pin1"};
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_EQ(run.columns.size(), 1U + 2 * 8 + 4);
  EXPECT_EQ(run.joints.size(), 2000U);
  const double first = 9.81 / (2 * std::sqrt(3.0));
  EXPECT_NEAR(run.at(0, run.column("joint.pin0.on_bar0.fy[world]")), first, 1e-4 * first);
  EXPECT_NEAR(run.at(0, run.column("joint.pin1.on_bar1.fy[world]")), (std::sqrt(3.0) - 2) * first, 1e-4 * first);
  EXPECT_LT(std::abs(run.energy.drift), 1e-4 * run.energy.kinetic_peak);
}

TEST(LargeModels, ManyColumnsAreLeftOutUnlessTheyAreAskedFor) {
  Model model = ladder_model(5000);
  const System system = build_system(model);
  const auto kept = [&] {
    const Recording out = choose_recording(model, system);
    return std::count(out.body.begin(), out.body.end(), true) + std::count(out.joint.begin(), out.joint.end(), true);
  };
  EXPECT_EQ(kept(), 0);
  EXPECT_NE(choose_recording(model, system).note.find("15001 joints"), std::string::npos);
  model.simulate.record = {"joint.A*", "body.crank7"};
  EXPECT_EQ(kept(), 5002);
  EXPECT_EQ(choose_recording(model, system).note, "");
  model.simulate.record = {"all"};
  EXPECT_EQ(kept(), 10001 + 15001);
}

TEST(LargeModels, ASmallModelKeepsEverythingHoweverManyRows) {
  Model model = ladder_model(10);
  model.simulate.output_step = 1e-6;
  const System system = build_system(model);
  const Recording out = choose_recording(model, system);
  EXPECT_EQ(std::count(out.body.begin(), out.body.end(), true), 21);
  EXPECT_EQ(std::count(out.joint.begin(), out.joint.end(), true), 31);
  EXPECT_EQ(out.note, "");
}

TEST(LargeModels, ForcesOfVeryManyJointsAreTabledLessOften) {
  SimulateSettings settings;
  settings.duration = 10;
  EXPECT_DOUBLE_EQ(output_step_of(settings, 4), 10.0 / 500);
  EXPECT_DOUBLE_EQ(output_step_of(settings, 100000), 10.0 / 100);
  EXPECT_DOUBLE_EQ(output_step_of(settings, 100000000), 10.0 / 20);
  settings.output_step = 0.001;
  EXPECT_DOUBLE_EQ(output_step_of(settings, 100000), 0.001);
}

TEST(LargeModels, TheLatticeOfParallelogramsMovesRowByRow) {
  const System system = build_system(grid_model(20));
  EXPECT_EQ(system.n_bodies(), 2 * 20 * 20 + 20);
  int constraints = 0;
  for (const JointData& joint : system.joints) constraints += joint.type == "revolute" ? 2 : 0;
  EXPECT_EQ(3 * system.n_bodies() - constraints, 20);
  EXPECT_LE(system.pattern().n_off_diagonal(), 6 * system.n_bodies());
}

}  // namespace
}  // namespace pintle::sample
