// N four-bars in a row, through positions where all bars are in line: on the regular branch all cranks stay parallel and turn as one rotating pendulum. With
// compliant pins the bars may leave their line sideways by sqrt(2 x stretch / length): a passage leaves some 1e-4 rad of that, which slows the crank by some
// 1e-3 rad per turn, at any tolerance.
#include <gtest/gtest.h>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

// Every crank parallel to the first one, every coupler level.
void expect_regular_branch(const Trajectory& run, int n, double tolerance) {
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double first = value(run, row, "body.crank0.angle");
    for (int i = 1; i <= n; ++i) ASSERT_NEAR(value(run, row, "body.crank" + std::to_string(i) + ".angle"), first, tolerance) << run.at(row, 0);
    for (int i = 0; i < n; ++i) ASSERT_NEAR(value(run, row, "body.coupler" + std::to_string(i) + ".angle"), 0, tolerance) << run.at(row, 0);
    if (row > 0) {
      ASSERT_LT(first, value(run, row - 1, "body.crank0.angle"));  // keeps turning
    }
  }
}

void expect_known(const Trajectory& run, const reference::Table& exact, double from, double until, double tolerance) {
  for (std::size_t i = 0; i < exact.rows.size() && exact.at(i, "t") < until + 1e-9; ++i) {
    if (exact.at(i, "t") < from - 1e-9) continue;
    const std::size_t row = reference::row_at(run, exact.at(i, "t"));
    EXPECT_NEAR(value(run, row, "body.crank0.angle"), exact.at(i, "theta"), tolerance) << exact.at(i, "t");
    EXPECT_NEAR(value(run, row, "body.crank0.spin"), exact.at(i, "omega"), 10 * tolerance) << exact.at(i, "t");
    EXPECT_NEAR(2 * value(run, row, "body.crank0.x"), exact.at(i, "B0x"), tolerance) << exact.at(i, "t");
    EXPECT_NEAR(2 * value(run, row, "body.crank0.y"), exact.at(i, "B0y"), tolerance) << exact.at(i, "t");
  }
}

// The crank of N loops by the classical Runge-Kutta method with small steps.
double crank_angle(int n, double t) {
  const double J = (n + 1) / 3.0 + n, S = (n + 1) / 2.0 + n;
  const auto accel = [&](double angle) { return -9.81 * S / J * std::cos(angle); };
  double angle = std::numbers::pi / 2, spin = -1;
  const int steps = static_cast<int>(std::ceil(t * 2000));
  const double h = t / steps;
  for (int i = 0; i < steps; ++i) {
    const double a1 = accel(angle), s1 = spin, a2 = accel(angle + h / 2 * s1), s2 = spin + h / 2 * a1, a3 = accel(angle + h / 2 * s2),
                 s3 = spin + h / 2 * a2, a4 = accel(angle + h * s3), s4 = spin + h * a3;
    angle += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
    spin += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return angle;
}

TEST(ReferenceNFourBar, OneLoopKeepsToItsBranch) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_1"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  expect_regular_branch(run, 1, 1e-5);
  EXPECT_LT(run.energy.drift, 1e-3);
  for (const double t : {1.0, 5.0, 10.0}) EXPECT_NEAR(value(run, reference::row_at(run, t), "body.crank0.angle"), crank_angle(1, t), 1e-4);
}

TEST(ReferenceNFourBar, TwoLoopsAreTheKnownOnes) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_2"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  expect_regular_branch(run, 2, 3e-4);
  const reference::Table exact = reference::read_table("n_four_bar_2");
  expect_known(run, exact, 0, 0.5, 1e-6);  // before the first passage
  expect_known(run, exact, 0.5, 2, 3e-4);
  expect_known(run, exact, 2, 10, 2e-2);
  EXPECT_LT(run.energy.drift, 1e-3);
}

TEST(SlowReferenceNFourBar, TenLoopsKeepToTheirBranch) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_10", {"simulate.duration=4"}));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  expect_regular_branch(run, 10, 3e-4);
  EXPECT_NEAR(value(run, reference::row_at(run, 4), "body.crank0.angle"), crank_angle(10, 4), 1e-3);
}

TEST(SlowReferenceNFourBar, FortyLoopsAreTheKnownOnes) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_40", {"simulate.duration=2"}));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  expect_regular_branch(run, 40, 3e-4);
  expect_known(run, reference::read_table("n_four_bar_40"), 0, 2, 1e-3);
}

}  // namespace
}  // namespace pintle
