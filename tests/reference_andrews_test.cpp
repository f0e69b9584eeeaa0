// Andrews' squeezer with stiff pins against the solution with ideal ones.
#include <gtest/gtest.h>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

TEST(ReferenceAndrews, MotionAndForcesAreThePublishedOnes) {
  Model model = reference::mechanism("andrews");
  reference::set_joints(model, 1e11, 1e4);
  model.simulate.tolerance = 1e-6;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const reference::Table ideal = reference::read_table("andrews");
  for (std::size_t i = 0; i < ideal.rows.size(); ++i) {
    const std::size_t row = reference::row_at(run, ideal.at(i, "t"));
    const auto angle = [&](const char* body) { return value(run, row, std::string("body.") + body + ".angle"); };
    const double beta = angle("K1"), delta = angle("K5"), epsilon = angle("K7");
    EXPECT_NEAR(beta, ideal.at(i, "beta"), 2e-5) << i;
    EXPECT_NEAR(angle("K2") - beta, ideal.at(i, "Theta"), 2e-5) << i;
    EXPECT_NEAR(angle("K3"), ideal.at(i, "gamma"), 2e-5) << i;
    EXPECT_NEAR(angle("K4") - delta, ideal.at(i, "Phi"), 2e-5) << i;
    EXPECT_NEAR(delta, ideal.at(i, "delta"), 2e-5) << i;
    EXPECT_NEAR(angle("K6") - epsilon, ideal.at(i, "Omega"), 2e-5) << i;
    EXPECT_NEAR(epsilon, ideal.at(i, "epsilon"), 2e-5) << i;
    EXPECT_NEAR(value(run, row, "body.K1.spin"), ideal.at(i, "beta_rate"), 2e-2) << i;
    EXPECT_LT(reference::force_error(run, row, "E3.on_K3", ideal.at(i, "lambda_1"), ideal.at(i, "lambda_2")), 2e-2) << i;
    EXPECT_LT(reference::force_error(run, row, "E4.on_K4", ideal.at(i, "lambda_3"), ideal.at(i, "lambda_4")), 2e-2) << i;
    EXPECT_LT(reference::force_error(run, row, "E6.on_K6", ideal.at(i, "lambda_5"), ideal.at(i, "lambda_6")), 2e-2) << i;
  }
  // The published end point of the crank.
  EXPECT_NEAR(value(run, run.n_rows() - 1, "body.K1.angle"), 15.81077119629904, 2e-5);
}

// The pins of the collection's file, 1e8 N/m, are a little softer than that.
TEST(ReferenceAndrews, FileOfTheCollectionIsCloseToIt) {
  const Trajectory run = simulate(reference::mechanism("andrews"));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_NEAR(value(run, run.n_rows() - 1, "body.K1.angle"), 15.81077119629904, 0.02);
}

}  // namespace
}  // namespace pintle
