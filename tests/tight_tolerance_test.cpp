// The tightest tolerances: what is at rounding costs no endless steps, and the forces are what was asked for.
#include <gtest/gtest.h>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// Accelerations at the start of a step differ from those inside it by what the step before has moved positions onto their gaps, and
// by rounding. Steps that tried to resolve either were a million times too short.
TEST(TightTolerance, IsMetInStepsOfTheMotion) {
  for (const char* name : {"inverted_slider_crank", "scissor_lift"}) {
    Model model = reference::mechanism(name);
    model.simulate.tolerance = 1e-9;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << name << ": " << run.message;
    EXPECT_LT(run.counters.steps + run.counters.rejected, 20000u) << name;
    for (const LoadSummary& joint : run.joints) EXPECT_LE(joint.relative_error_estimate, 1e-9) << name << ", " << joint.name;
  }
}

// Springs and gravity of a thousand newtons cancel to their rounding, and the guide carries nothing: there is nothing to resolve.
TEST(TightTolerance, NothingMovesInFewSteps) {
  Model model = reference::test_model("two_masses_at_rest");
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LT(run.counters.steps + run.counters.rejected, 500u) << tolerance;
  }
}

// The rounding of an angle of a hundred radians is a couple beside that of a servo that only keeps a small rotor turning.
TEST(TightTolerance, TakesStepsOfTheMotionWhereAServoIsStiffForItsInertia) {
  Model model = reference::test_model("whirling_rotor");
  const double peak = simulate(model).joints.front().peak;
  model.simulate.tolerance = 1e-7;
  const Trajectory run = simulate(model);
  EXPECT_LT(run.counters.steps + run.counters.rejected, 50000u);
  EXPECT_NEAR(run.joints.front().peak, peak, 1e-5 * peak);
}

}  // namespace
}  // namespace pintle
