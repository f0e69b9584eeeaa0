// Variants in lanes against runs of their own.
#include "batch/batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "batch/batch_work.h"
#include "batch/envelope.h"
#include "integrators/start_states_for_tests.h"
#include "pintle/simulate.h"
#include "simd/processor_registers.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

constexpr double kBatchTolerance = 1e-4;

Model batch_model(double stiffness = 1e8, double mass = 1) {
  Model model = sample::four_bar(stiffness, 3000);
  model.simulate.duration = 0.63;
  model.simulate.tolerance = kBatchTolerance;
  model.bodies[1].mass *= mass;
  return model;
}

// A pendulum with a torsion spring and a force over time: loads are evaluated variant by variant.
Model loaded_pendulum(double pull = 5) {
  Model model = sample::pendulum(2e8, 3500);
  model.simulate.duration = 2;
  model.simulate.tolerance = kBatchTolerance;
  model.springs = {sample::spring("coil", true, {"ground", "O"}, {"rod", "O"}, 3, 0.1)};
  AppliedForce force;
  force.name = "pull";
  force.on = {"rod", "O"};
  force.force = {sample::expression(std::to_string(pull) + "*sin(3*t)"), sample::expression("0")};
  force.torque = sample::expression("1 + t");
  model.forces = {force};
  return model;
}

// The crank is light, and follows a motor.
Model driven_four_bar(double speed = 10) {
  Model model = batch_model();
  model.bodies[0].inertia = 0.1;
  Motor motor = sample::motor("drive", model.joints[0].name, MotorKind::kPosition, sample::expression(std::to_string(speed) + "*t + 0.05*sin(2*t)"));
  motor.stiffness = 1e8;
  motor.damping = 1e4;
  model.motors = {motor};
  return model;
}

std::optional<BatchPlan> plan_for(const Model& model) {
  NominalRun nominal;
  const Trajectory run = simulate_reduced(model, {Recorded::kForces, true, nullptr, &nominal});
  return plan_batch(model, nominal, run);
}

void expect_near(const BatchResult& result, const BatchPlan& plan, Model model) {
  ASSERT_TRUE(result.good);
  model.simulate.tolerance = 1e-7;
  const Trajectory truth = simulate(model);
  std::size_t row = 0;
  for (std::size_t j = 0; j < result.joints.size(); ++j) {
    if (plan.base.joints[j].servo >= 0) continue;
    const LoadSummary& joint = truth.joints[row++];
    EXPECT_NEAR(result.joints[j].force, joint.peak, kBatchTolerance * joint.peak) << joint.name;
    EXPECT_NEAR(result.joints[j].time, joint.peak_time, 0.005 * model.simulate.duration) << joint.name;
    EXPECT_NEAR(result.joints[j].couple, joint.peak_moment, kBatchTolerance * std::max(joint.peak_moment, 1e-3 * joint.peak)) << joint.name;
  }
}

TEST(Batch, PeaksAreThoseOfRuns) {
  const std::vector<std::vector<Model>> kinds{{batch_model(), batch_model(5e7), batch_model(1e9), batch_model(1e8, 1.3)},
                                              {loaded_pendulum(), loaded_pendulum(5.5), loaded_pendulum(4)},
                                              {driven_four_bar(), driven_four_bar(10.5)}};
  for (const std::vector<Model>& variants : kinds) {
    const auto plan = plan_for(variants[0]);
    ASSERT_TRUE(plan.has_value()) << variants[0].name;
    Batch batch(*plan);
    for (std::size_t i = 0; i < variants.size(); ++i) ASSERT_TRUE(batch.accepts(variants[i]) && batch.put(static_cast<int>(i), variants[i]));
    const auto results = batch.run();
    for (std::size_t i = 0; i < variants.size(); ++i) expect_near(results[i], *plan, variants[i]);
  }
}

TEST(Batch, DependsOnNoNeighbour) {
  const auto plan = plan_for(batch_model());
  ASSERT_TRUE(plan.has_value());
  Batch batch(*plan);
  const Model variant = batch_model(8e7, 1.1);
  ASSERT_TRUE(batch.put(5, variant));
  const BatchResult alone = batch.run()[5];
  for (int lane = 0; lane < kVariantLanes; ++lane) ASSERT_TRUE(batch.put(lane, lane == 2 ? variant : batch_model((5 + lane) * 1e7, 1 + 0.2 * lane)));
  const BatchResult among = batch.run()[2];
  ASSERT_TRUE(alone.good && among.good);
  for (std::size_t j = 0; j < alone.joints.size(); ++j) {
    EXPECT_EQ(alone.joints[j].force, among.joints[j].force);
    EXPECT_EQ(alone.joints[j].time, among.joints[j].time);
  }
}

#if PINTLE_BUILDS_256 && PINTLE_BUILDS_512
TEST(Batch, WidthsOfRegistersGiveTheSameBits) {
  const auto plan = plan_for(driven_four_bar());
  ASSERT_TRUE(plan.has_value());
  std::vector<std::unique_ptr<BatchWork>> works;
  works.push_back(bits128::make_batch_work(*plan));
  if (has_wide_registers()) works.push_back(bits256::make_batch_work(*plan));
  if (has_widest_registers()) works.push_back(bits512::make_batch_work(*plan));
  if (works.size() == 1) GTEST_SKIP() << "this processor has registers of one width only";
  const State start = sample::plain_start(driven_four_bar(), plan->base);
  for (const auto& work : works) {
    for (int lane = 0; lane < kVariantLanes; ++lane) work->put(lane, plan->base, start.q, start.v, plan->duration * (1 + 0.01 * lane));
    work->run();
    for (int lane = 0; lane < kVariantLanes; ++lane) {
      EXPECT_LT(work->worst()[lane], 1);
      EXPECT_EQ(work->worst()[lane], works[0]->worst()[lane]);
      for (std::size_t j = 0; j < work->peaks().size(); ++j) EXPECT_EQ(work->peaks()[j].square[lane], works[0]->peaks()[j].square[lane]);
    }
  }
}
#endif

TEST(Batch, WhatIsNotForOneIsRefused) {
  Model motion = batch_model(), raw = batch_model(), jump = loaded_pendulum();
  motion.simulate.tolerance_of = ToleranceOf::kMotion;
  raw.simulate.start = Start::kRaw;
  jump.forces[0].torque = sample::expression("sign(t - 1)");
  EXPECT_FALSE(plan_for(motion).has_value());
  EXPECT_FALSE(plan_for(raw).has_value());
  EXPECT_FALSE(plan_for(jump).has_value());
  EXPECT_FALSE(plan_for(batch_model(1e5)).has_value()) << "its joints are soft";

  const auto plan = plan_for(batch_model());
  ASSERT_TRUE(plan.has_value());
  Batch batch(*plan);
  Model fewer_rows = batch_model(), finer = batch_model();
  fewer_rows.simulate.output_step = fewer_rows.simulate.duration / 100;
  finer.simulate.tolerance = 1e-6;
  EXPECT_TRUE(batch.accepts(fewer_rows)) << "peaks do not depend on the rows";
  EXPECT_FALSE(batch.accepts(finer));
  EXPECT_FALSE(batch.put(0, batch_model(1e6))) << "its joints are soft";
}

// A variant much faster than the base, whose steps are too long for it. The envelope comes from a run of its own.
TEST(Batch, AVariantThatNeedsShorterStepsSaysSo) {
  const Model base = driven_four_bar();
  Model fast = driven_four_bar(30);
  for (Body& body : fast.bodies) {
    body.spin = {};
    body.velocity = {};
  }
  const auto plan = plan_for(base);
  ASSERT_TRUE(plan.has_value());
  Batch batch(*plan);
  ASSERT_TRUE(batch.put(0, fast));
  EXPECT_FALSE(batch.run()[0].good);
  const std::vector<Variant> variants{{fast, false}};
  const auto results = EnvelopeEngine(base, {{}, true}).run(variants, [] { return true; });
  Model fine = fast;
  fine.simulate.tolerance = 1e-7;
  const Trajectory truth = simulate(fine);
  for (std::size_t j = 0; j < truth.joints.size(); ++j) EXPECT_NEAR(results[0].joints[j].force, truth.joints[j].peak, kBatchTolerance * truth.joints[j].peak);
}

}  // namespace
}  // namespace pintle
