// Andrews' squeezer: all 27 components of the Test Set for IVP Solvers, their limit for stiff pins, and problem A03 of the IFToMM library with the forces of
// its ten pins.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/published/andrews_components.h"
#include "tests/reference_tables.h"

namespace pintle {
namespace {

using published::Components;
using reference::value;

nlohmann::json facts(const std::string& name) {
  std::ifstream file(std::string(PINTLE_SOURCE_DIR) + "/bench/published/" + name + ".json");
  return nlohmann::json::parse(file);
}

Model andrews(double k, const std::vector<std::string>& overrides = {}) {
  Model model = reference::mechanism("andrews", overrides);
  reference::set_joints(model, k, published::damping_at(k));
  return model;
}

// Largest relative difference of components [from, to).
double difference(const Components& y, const std::vector<double>& from_facts, std::size_t from, std::size_t to) {
  double largest = 0;
  for (std::size_t i = from; i < to; ++i) largest = std::max(largest, std::abs(y[i] / from_facts[i] - 1));
  return largest;
}

// The published end is accurate to 9.6 digits in the angles and 5.9 in accelerations and multipliers; the exact one to 12.
TEST(PublishedAndrews, StiffPinsTendToThePublishedEnd) {
  const nlohmann::json known = facts("ivp_andrews");
  const std::vector<double> exact = known["exact"], printed = known["published"];
  ASSERT_EQ(exact.size(), 27U);
  const Components soft = published::end_of(andrews(1e10), 1e-8).y, stiff = published::end_of(andrews(1e11), 1e-8).y;
  EXPECT_NEAR(difference(soft, exact, 0, 7) / difference(stiff, exact, 0, 7), 10, 0.5);
  const Components limit = published::extrapolated(soft, stiff);
  EXPECT_LT(difference(limit, exact, 0, 7), 1e-6);
  EXPECT_LT(difference(limit, printed, 0, 7), 1e-6);
  EXPECT_LT(difference(limit, exact, 7, 14), 1e-4);
  EXPECT_LT(difference(limit, exact, 14, 21), 1e-4);
  EXPECT_LT(difference(limit, exact, 21, 27), 1e-4);
}

TEST(PublishedAndrews, IdealPinsGiveAllComponents) {
  const std::vector<double> exact = facts("ivp_andrews")["exact"];
  Model model = andrews(1e8);
  model.simulate.equations = Equations::kIdeal;
  const Components y = published::end_of(model, 1e-10).y;
  EXPECT_LT(difference(y, exact, 0, 7), 1e-8);
  EXPECT_LT(difference(y, exact, 7, 27), 1e-6);
}

double force_error(const Trajectory& run, const Model& model, const nlohmann::json& forces) {
  double worst = 0;
  for (std::size_t j = 0; j < forces["joints"].size(); ++j) {
    const std::string name = forces["joints"][j];
    const auto joint = std::find_if(model.joints.begin(), model.joints.end(), [&](const Joint& x) { return x.name == name; });
    const std::string column = name + ".on_" + joint->second.body;
    double peak = 0, error = 0;
    for (const auto& at : forces["rows"]) {
      const double x = at[1 + 2 * j], y = at[2 + 2 * j];
      peak = std::max(peak, std::hypot(x, y));
      error = std::max(error, reference::force_error(run, reference::row_at(run, at[0]), column, x, y));
    }
    worst = std::max(worst, error / peak);
  }
  return worst;
}

TEST(PublishedAndrews, TenPinForcesTendToThoseOfIdealPins) {
  const nlohmann::json forces = facts("ivp_andrews")["forces"];
  std::vector<double> errors;
  for (const double k : {1e10, 1e11, 1e12}) {
    Model model = andrews(k, {"simulate.output_step=0.0025"});
    model.simulate.tolerance = 1e-7;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    errors.push_back(force_error(run, model, forces));
  }
  EXPECT_NEAR(errors[0] / errors[1], 10, 0.5);
  EXPECT_NEAR(errors[1] / errors[2], 10, 0.5);
  EXPECT_LT(errors[2], 1e-5);
}

// The library's start is different, and its run longer: point F, the energy balance, and the pins.
TEST(PublishedAndrews, LibrarysProblemToTheEnd) {
  const nlohmann::json known = facts("iftomm_a03");
  Model model = andrews(1e12, {"parameters.beta=-0.062", "simulate.duration=0.05", "simulate.output_step=0.0025"});
  model.simulate.tolerance = 1e-7;
  const Trajectory run = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  for (const auto& at : known["exact"]["rows"]) {
    const std::size_t row = reference::row_at(run, at[0]);
    const double beta = value(run, row, "body.K1.angle");
    EXPECT_NEAR(0.007 * std::cos(beta), at[1].get<double>(), 1e-6);
    EXPECT_NEAR(0.007 * std::sin(beta), at[2].get<double>(), 1e-6);
    // The energy is the work of the motor's constant torque.
    const double energy = value(run, row, "energy.kinetic") + value(run, row, "energy.potential"),
                 first = value(run, 0, "energy.kinetic") + value(run, 0, "energy.potential");
    EXPECT_NEAR(energy - first, 0.033 * (beta - value(run, 0, "body.K1.angle")), 1e-6);
  }
  EXPECT_LT(force_error(run, model, known["forces"]), 1e-4);
}

}  // namespace
}  // namespace pintle
