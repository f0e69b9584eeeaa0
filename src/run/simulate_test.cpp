// Whole runs of the paper's mechanisms: known values, reliable stated errors, the energy account, interruption.
#include "pintle/simulate.h"

#include <gtest/gtest.h>

#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

double last(const Trajectory& run, const std::string& column) {
  const int c = run.column(column);
  EXPECT_GE(c, 0) << column;
  return c < 0 ? std::nan("") : run.at(run.n_rows() - 1, c);
}

// k = 2e8 N/m, c = 3500 N s/m, g = 9.81, zero stretch at the start: two explicit runs with tolerances 1e-12 and 1e-10 agree
// on these to 2e-7 N (paper, section 7, in this program's axes).
TEST(Simulate, PendulumIsTheKnownOneAndItsErrorEstimateHolds) {
  for (const double tolerance : {1e-4, 1e-6}) {
    Model model = sample::pendulum(2e8, 3500);
    model.simulate.start = Start::kUnloaded;
    model.simulate.duration = 2;
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_EQ(run.t_end, 2);
    EXPECT_EQ(run.n_rows(), 501u);
    EXPECT_NEAR(last(run, "body.rod.x"), 0.4997327517228443, 10 * tolerance);
    EXPECT_NEAR(last(run, "body.rod.y"), -0.01634566800062588, 10 * tolerance);
    const double ex = last(run, "joint.pin.on_rod.fx[world]") + 0.721191932908892;
    const double ey = last(run, "joint.pin.on_rod.fy[world]") - 2.476089240913748;
    ASSERT_EQ(run.joints.size(), 1u);
    EXPECT_LE(std::hypot(ex, ey), run.joints[0].error_estimate + 2e-7);
    EXPECT_LE(run.joints[0].relative_error_estimate, tolerance);
    EXPECT_NEAR(run.joints[0].peak, 2.5 * 9.81, 0.01);  // straight down: its weight, and 3/2 of it to move in a circle
    EXPECT_LT(run.energy.drift, 10 * tolerance);
  }
}

// Ideal joints after 0.5236 s, crank from 60 degrees; the compliant ones (k = 1e8, c = 3000) are within 0.02 N of them.
TEST(Simulate, FourBarIsTheKnownOne) {
  Model model = sample::four_bar(1e8, 3000);
  model.simulate.duration = 0.5235987755982989;
  const Trajectory run = simulate(model);
  EXPECT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_NEAR(last(run, "body.crank.angle"), 6.283139932651989, 1e-6);
  EXPECT_NEAR(last(run, "body.coupler.angle"), 0.8956738685655716, 5e-6);
  EXPECT_NEAR(last(run, "body.follower.angle"), 2.2459369348352505, 5e-6);
  EXPECT_NEAR(last(run, "joint.O2.on_crank.fx[world]"), -381.25045025822726, 0.02);
  EXPECT_NEAR(last(run, "joint.A.on_coupler.fy[world]"), -245.9225433689088, 0.02);
  EXPECT_NEAR(last(run, "joint.B.on_follower.fx[world]"), -31.271992446482503, 0.02);
  EXPECT_NEAR(last(run, "joint.O4.on_follower.fx[world]"), -68.71082770119705, 0.02);
  EXPECT_NEAR(last(run, "joint.O4.on_follower.fy[world]"), 3.8409867671042224, 0.02);
  EXPECT_LT(run.energy.drift, 1e-9 * run.energy.kinetic_start);
}

// A joint acts on its first body with the opposite of its force on the second.
TEST(Simulate, ColumnsOfBothBodiesAreOpposite) {
  Model model = sample::four_bar(1e8, 3000);
  model.simulate.duration = 0.05;
  const Trajectory run = simulate(model);
  const int a = run.column("joint.A.on_coupler.fx[world]"), b = run.column("joint.A.on_crank.fx[world]");
  ASSERT_GE(a, 0);
  ASSERT_GE(b, 0);
  for (std::size_t row = 0; row < run.n_rows(); ++row) EXPECT_EQ(run.at(row, a), -run.at(row, b));
}

TEST(Simulate, BothMethodsAgree) {
  Model model = sample::pendulum(1e6, 2000);
  model.simulate.duration = 0.3;
  model.simulate.tolerance = 1e-6;
  const Trajectory implicit = simulate(model);
  model.simulate.method = "dopri5";
  const Trajectory direct = simulate(model);
  EXPECT_EQ(direct.method, "dopri5");
  for (const char* column : {"joint.pin.on_rod.fx[world]", "joint.pin.on_rod.fy[world]", "body.rod.angle"})
    EXPECT_NEAR(last(implicit, column), last(direct, column), 1e-4) << column;
}

TEST(Simulate, StopsWhenAsked) {
  Model model = sample::pendulum(1e8, 10);
  model.simulate.start = Start::kUnloaded;
  model.simulate.duration = 1e4;
  model.simulate.output_step = 1e-2;  // a million rows: no machine is fast enough to reach the end before it has asked twice
  int asked = 0;
  const Trajectory run = simulate(model, [&](const Progress& progress) {
    EXPECT_EQ(progress.duration, 1e4);
    return ++asked < 2;
  });
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(run.outcome, Outcome::kInterrupted);
  EXPECT_LT(run.t_end, 1e4);
  EXPECT_GE(run.n_rows(), 2u);
}

}  // namespace
}  // namespace pintle
