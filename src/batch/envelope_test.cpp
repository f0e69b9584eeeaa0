// The envelopes of variants are those of runs, regardless of a variant's neighbours.
#include "batch/envelope.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pintle/simulate.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

Model envelope_model(double stiffness, double tolerance) {
  Model model = sample::four_bar(stiffness, 3000);
  model.simulate.duration = 0.63;
  model.simulate.tolerance = tolerance;
  return model;
}

bool always() { return true; }

TEST(Envelope, OfACheckedVariantIsTheRunBitForBit) {
  const Model model = envelope_model(1e8, 1e-4);
  const Trajectory run = simulate(model);
  const EnvelopeEngine engine(model, {{"joint.B.on_follower.fx[world]", "body.crank.angle"}, false});
  for (const bool series : {false, true}) {
    const std::vector<Variant> variants{{model, true}};
    const auto results = (series ? engine : EnvelopeEngine(model, {})).run(variants, always);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].status, SampleStatus::kCompleted);
    EXPECT_EQ(results[0].steps, run.counters.steps);
    ASSERT_EQ(results[0].joints.size(), run.joints.size());
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      EXPECT_EQ(results[0].joints[j].force, run.joints[j].peak);
      EXPECT_EQ(results[0].joints[j].time, run.joints[j].peak_time);
      EXPECT_EQ(results[0].joints[j].moment, run.joints[j].peak_moment);
      EXPECT_EQ(results[0].joints[j].error, run.joints[j].error_estimate);
    }
    if (!series) continue;
    ASSERT_EQ(engine.n_times(), run.n_rows());
    ASSERT_EQ(results[0].series.size(), 2 * run.n_rows());
    const auto column = static_cast<std::size_t>(run.column("body.crank.angle"));
    for (std::size_t i = 0; i < run.n_rows(); ++i) EXPECT_EQ(results[0].series[run.n_rows() + i], run.at(i, column));
  }
}

// One integration is as accurate as requested; it just does not prove it.
TEST(Envelope, OfAnUncheckedVariantIsWithinTheTolerance) {
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    const Trajectory truth = simulate(envelope_model(stiffness, 1e-8));
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      const Model model = envelope_model(stiffness, tolerance);
      const std::vector<Variant> variants{{model, false}};
      const auto results = EnvelopeEngine(envelope_model(1e8, tolerance), {{}, true}).run(variants, always);
      EXPECT_EQ(results[0].passes, 1u);
      for (std::size_t j = 0; j < truth.joints.size(); ++j) {
        EXPECT_NEAR(results[0].joints[j].force, truth.joints[j].peak, tolerance * truth.joints[j].peak) << stiffness << ' ' << tolerance;
        EXPECT_TRUE(std::isnan(results[0].joints[j].error));
      }
    }
  }
}

TEST(Envelope, DependsOnNoNeighbour) {
  const Model base = envelope_model(1e8, 1e-4);
  std::vector<Variant> variants;
  for (const double stiffness : {1e6, 3e7, 1e8, 1e9}) variants.push_back({envelope_model(stiffness, 1e-4), true});
  const EnvelopeEngine engine(base, {});
  const auto together = engine.run(variants, always);
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const auto alone = engine.run({&variants[i], 1}, always);
    for (std::size_t j = 0; j < alone[0].joints.size(); ++j) EXPECT_EQ(alone[0].joints[j].force, together[i].joints[j].force);
  }
}

TEST(Envelope, AVariantThatCannotBeAssembledIsAResult) {
  const Model base = envelope_model(1e8, 1e-4);
  Model open = base;
  open.ground[1].position = {20, 0};
  const std::vector<Variant> variants{{open, true}, {base, true}};
  const auto results = EnvelopeEngine(base, {}).run(variants, always);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].status, SampleStatus::kNotAssembled);
  EXPECT_NE(results[0].message, "");
  EXPECT_EQ(results[1].status, SampleStatus::kCompleted);
}

TEST(Envelope, StopsWhenTold) {
  const Model base = envelope_model(1e8, 1e-4);
  const std::vector<Variant> variants{{base, true}};
  EXPECT_TRUE(EnvelopeEngine(base, {}).run(variants, [] { return false; }).empty());
}

TEST(Envelope, CountsTheRowsOfARun) {
  for (const double duration : {1.0, 0.3, 2.0 / 3})
    for (const double step : {0.0, 0.1, 0.07, 0.3, duration, (1 - 1e-12) * duration}) {
      Model model = sample::pendulum(2e8, 3500);
      model.simulate.duration = duration;
      model.simulate.output_step = step;
      if (step > duration) continue;
      EXPECT_EQ(EnvelopeEngine(model, {}).n_times(), simulate(model).n_rows()) << duration << ' ' << step;
    }
}

TEST(Envelope, AMisspeltColumnIsNamed) {
  try {
    EnvelopeEngine(envelope_model(1e8, 1e-4), {{"body.crank.angel"}, false});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("body.crank.angle"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pintle
