// Sweeps of the collection: peaks of unchecked variants, most of them in batches, against runs with a smaller tolerance.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "batch/envelope.h"
#include "pintle/read_model.h"
#include "pintle/simulate.h"

namespace pintle {
namespace {

constexpr double kSweepTolerance = 1e-4;

Model collected(const std::string& name) {
  Model model = read_model(PINTLE_SOURCE_DIR "/mechanisms/" + name + ".toml");
  model.simulate.tolerance = kSweepTolerance;
  return model;
}

// Heavier by `factor`, and with a first joint stiffer by the same factor.
Model heavier(Model model, double factor) {
  for (Body& body : model.bodies) body.mass *= factor;
  auto& stiffness = model.joints[0].law.values["stiffness"];
  for (double& k : stiffness) k *= factor;
  return model;
}

class Batches : public testing::TestWithParam<std::string> {};

TEST_P(Batches, PeaksAreWithinTheTolerance) {
  const Model base = collected(GetParam());
  const std::vector<double> factors{0.9, 1.0, 1.07};
  std::vector<Variant> variants;
  for (const double factor : factors) variants.push_back({heavier(base, factor), false});
  const auto results = EnvelopeEngine(base, {{}, true}).run(variants, [] { return true; });
  for (std::size_t i = 0; i < variants.size(); ++i) {
    // Others may need shorter steps; in a batch or not, their peaks are right.
    EXPECT_TRUE(results[i].in_batch || factors[i] != 1);
    Model fine = variants[i].model;
    fine.simulate.tolerance = 1e-6;
    const Trajectory truth = simulate(fine);
    double largest = 0;
    for (const LoadSummary& joint : truth.joints) largest = std::max(largest, joint.peak);
    ASSERT_EQ(results[i].joints.size(), truth.joints.size());
    for (std::size_t j = 0; j < truth.joints.size(); ++j)
      EXPECT_NEAR(results[i].joints[j].force, truth.joints[j].peak, kSweepTolerance * std::max(truth.joints[j].peak, 1e-4 * largest)) << truth.joints[j].name << ' ' << factors[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Collection, Batches, testing::Values("four_bar", "trammel", "pendulum", "andrews", "weld_beam"));

}  // namespace
}  // namespace pintle
