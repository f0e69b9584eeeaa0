// Problem A02 of the IFToMM library: the library's own solution file (N = 40), and the energy through singular positions.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

nlohmann::json n_four_bar_facts() {
  std::ifstream file(std::string(PINTLE_SOURCE_DIR) + "/bench/published/iftomm_a02.json");
  return nlohmann::json::parse(file);
}

// Largest departure of kinetic plus potential energy from its initial value; the pins' losses count.
double energy_error(const Trajectory& run) {
  const auto total = [&](std::size_t row) { return value(run, row, "energy.kinetic") + value(run, row, "energy.potential"); };
  double largest = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) largest = std::max(largest, std::abs(total(row) - total(0)));
  return largest;
}

TEST(SlowPublishedNFourBar, FortyLoopsFollowTheSolutionFile) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_40", {"simulate.duration=1"}));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const nlohmann::json known = n_four_bar_facts();
  int rows = 0;
  for (const auto& at : known["published"]["rows"]) {
    if (at[0].get<double>() > 1) continue;
    const std::size_t row = reference::row_at(run, at[0]);
    EXPECT_NEAR(2 * value(run, row, "body.crank0.x"), at[1].get<double>(), 1e-3);  // the library's class of high precision
    EXPECT_NEAR(2 * value(run, row, "body.crank0.y"), at[2].get<double>(), 1e-3);
    ++rows;
  }
  EXPECT_EQ(rows, 5);
  EXPECT_LT(energy_error(run), known["tolerance"]["energy [J]"].get<double>());
}

TEST(PublishedNFourBar, TwoLoopsKeepTheirEnergyThroughEightPassages) {
  const Trajectory run = simulate(reference::mechanism("n_four_bar_2", {"simulate.duration=4"}));
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const double turned = value(run, 0, "body.crank0.angle") - value(run, run.n_rows() - 1, "body.crank0.angle");
  EXPECT_GT(turned, 4 * std::numbers::pi);
  const nlohmann::json known = n_four_bar_facts();
  EXPECT_LT(energy_error(run), known["tolerance"]["energy [J]"].get<double>());
  for (const auto& at : known["exact_2"]["rows"]) {
    if (at[0].get<double>() > 4) continue;
    const std::size_t row = reference::row_at(run, std::round(20 * at[0].get<double>()) / 20);
    EXPECT_NEAR(2 * value(run, row, "body.crank0.x"), at[1].get<double>(), 0.1);  // the class of low precision
    EXPECT_NEAR(2 * value(run, row, "body.crank0.y"), at[2].get<double>(), 0.1);
  }
}

// Ten seconds to the class of high precision, through some twenty singular positions.
TEST(PublishedNFourBar, IdealLoopsFollowTheExactMotion) {
  Model model = reference::mechanism("n_four_bar_2");
  model.simulate.equations = Equations::kIdeal;
  const Trajectory run = simulate(model);
  ASSERT_NE(run.outcome, Outcome::kFailed) << run.message;
  const nlohmann::json known = n_four_bar_facts();
  for (const auto& at : known["exact_2"]["rows"]) {
    const std::size_t row = reference::row_at(run, at[0]);
    EXPECT_NEAR(2 * value(run, row, "body.crank0.x"), at[1].get<double>(), 1e-3);
    EXPECT_NEAR(2 * value(run, row, "body.crank0.y"), at[2].get<double>(), 1e-3);
  }
  EXPECT_LT(energy_error(run), 1e-3);
}

}  // namespace
}  // namespace pintle
