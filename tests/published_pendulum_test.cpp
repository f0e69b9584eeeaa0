// Problem A01 of the IFToMM library, 10 s: a point mass on a rod, against the library's solution file and the exact one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

using reference::value;

nlohmann::json pendulum_facts() {
  std::ifstream file(std::string(PINTLE_SOURCE_DIR) + "/bench/published/iftomm_a01.json");
  return nlohmann::json::parse(file);
}

// Damping proportional to the stiffness.
Trajectory swing(double k) {
  Model model = read_model(std::string(PINTLE_SOURCE_DIR) + "/bench/published/simple_pendulum.toml");
  reference::set_joints(model, k, 3e-7 * k);
  return simulate(model);
}

double largest_distance(const Trajectory& run, const nlohmann::json& rows) {
  double largest = 0;
  for (const auto& at : rows) {
    const double t = at[0];
    if (t > 10) continue;
    const std::size_t row = reference::row_at(run, t);
    largest = std::max(largest, std::hypot(value(run, row, "body.mass.x") - at[1].get<double>(), value(run, row, "body.mass.y") - at[2].get<double>()));
  }
  return largest;
}

TEST(PublishedPendulum, MotionIsThePublishedOne) {
  const Trajectory run = swing(1e12);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const nlohmann::json known = pendulum_facts();
  EXPECT_LT(largest_distance(run, known["exact"]["rows"]), 1e-7);
  EXPECT_LT(largest_distance(run, known["published"]["rows"]), 1e-6);  // printed to six places
  for (std::size_t row = 0; row < run.n_rows(); ++row)
    EXPECT_LT(std::abs(value(run, row, "energy.kinetic") + value(run, row, "energy.potential")), 5e-5);  // the library's is zero
}

// The rod's tension is m (v^2 - g y)/L; the remaining difference is the rod's stretch.
TEST(PublishedPendulum, TensionIsThatOfTheMotion) {
  const Trajectory run = swing(1e12);
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    const double x = value(run, row, "body.mass.x"), y = value(run, row, "body.mass.y"), vx = value(run, row, "body.mass.vx"), vy = value(run, row, "body.mass.vy");
    const double tension = vx * vx + vy * vy - 9.81 * y;
    EXPECT_LT(reference::force_error(run, row, "rod.on_mass", -tension * x, -tension * y), 1e-5) << run.at(row, 0);
  }
}

TEST(PublishedPendulum, IdealRodGivesThePublishedMotion) {
  Model model = read_model(std::string(PINTLE_SOURCE_DIR) + "/bench/published/simple_pendulum.toml");
  model.simulate.equations = Equations::kIdeal;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  const nlohmann::json known = pendulum_facts();
  EXPECT_LT(largest_distance(run, known["exact"]["rows"]), 1e-7);
  EXPECT_LT(largest_distance(run, known["published"]["rows"]), 1e-6);
}

TEST(PublishedPendulum, TheRodsComplianceIsAllTheDifference) {
  const nlohmann::json exact = pendulum_facts()["exact"]["rows"];
  const double soft = largest_distance(swing(1e7), exact), stiff = largest_distance(swing(1e8), exact);
  EXPECT_NEAR(soft / stiff, 10, 0.2);
}

}  // namespace
}  // namespace pintle
