// The tightest tolerances: quantities at roundoff do not cost endless steps, and the forces are as accurate as asked for.
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// Accelerations at the start of a step differ from those inside it by roundoff, and because the previous step has moved positions onto their gaps. Steps that
// tried to resolve either were a million times too short.
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

// Spring forces and gravity of a thousand newtons cancel to roundoff, and the guide carries nothing: there is nothing to resolve.
TEST(TightTolerance, NothingMovesInFewSteps) {
  Model model = reference::test_model("two_masses_at_rest");
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = simulate(model);
    EXPECT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_LT(run.counters.steps + run.counters.rejected, 500u) << tolerance;
  }
}

// The roundoff of an angle of a hundred radians gives a couple comparable with that of a servo that only keeps a small rotor turning.
TEST(TightTolerance, TakesStepsOfTheMotionWhereAServoIsStiffForItsInertia) {
  Model model = reference::test_model("whirling_rotor");
  const double peak = simulate(model).joints.front().peak;
  model.simulate.tolerance = 1e-7;
  const Trajectory run = simulate(model);
  EXPECT_LT(run.counters.steps + run.counters.rejected, 50000u);
  EXPECT_NEAR(run.joints.front().peak, peak, 1e-5 * peak);
}

// A blow is a thousand times as large as what the slope carries before it. Passes whose tolerance is relative to the small load come near roundoff, which no step resolves:
// there were millions of steps that tried to.
TEST(TightTolerance, SmallForcesBesideLargeOnesCostNoEndlessSteps) {
  Model model = reference::test_model("ball_to_a_wall");
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps + run.counters.rejected, 6000u) << tolerance;
  }
}

// Between events steps are short: the finer passes of a loose tolerance use order 9, as those of a tight one do.
TEST(TightTolerance, ALooseOneCostsNoMoreThanATightOne) {
  Model model = reference::test_model("bag_jaws");
  std::uint64_t before = 0;
  for (const double tolerance : {1e-6, 1e-5, 1e-4}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    const std::uint64_t steps = run.counters.steps + run.counters.rejected;
    if (before > 0) {
      EXPECT_LT(steps, before + before / 4) << tolerance;
    }
    before = steps;
  }
}

// Positions are rounded: from rest no step can come nearer to an event than that, and a run whose steps end before one over and over has reached it.
TEST(TightTolerance, AStrutPressesOnItsStopInFewSteps) {
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    Model model = reference::test_model("strut_on_its_stop");
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps + run.counters.rejected, 1000u) << tolerance;  // 36,000
  }
}

// The same where another body moves fast meanwhile. At each tolerance the run took 120,000 steps and failed.
TEST(TightTolerance, ABufferStruckWhereItsSpringBeginsLeavesThere) {
  for (const double tolerance : {1e-3, 1e-5}) {
    Model model = reference::test_model("buffer_struck_on_its_kink");
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps + run.counters.rejected, 40000u) << tolerance;
    EXPECT_NEAR(std::abs(run.motors.at(0).peak_effort), 1305.4, 0.2) << tolerance;  // 25 m/s 0.06 1.6/0.26 sqrt(1e5 N/m 0.2 kg), less what moves during the impact
  }
}

// The guide of a mass at its own centre carries a couple of a millionth of a newton metre, below the roundoff of a hundred radians times the guide's stiffness.
TEST(TightTolerance, CouplesOfRoundingTakeNoSteps) {
  Model model = reference::test_model("mass_in_a_turning_guide");
  for (const double tolerance : {1e-5, 1e-6, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps + run.counters.rejected, 15000u) << tolerance;
    EXPECT_NEAR(run.joints.at(1).peak, 40.3529, 1e-3) << tolerance;  // 2 m w A W of the mass on its spring
  }
}

// A shoe pressed onto its drum by a force that grows from zero. In the steady state its friction brakes the drum with 34.286 N m.
TEST(TightTolerance, ABodyWithoutLoadIsNotMeasuredByIts) {
  Model model = reference::test_model("shoe_on_a_drum");
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    model.simulate.tolerance = tolerance;
    const Trajectory run = reference::completed(model);
    EXPECT_LT(run.counters.steps + run.counters.rejected, 5000u) << tolerance;
    EXPECT_NEAR(reference::value(run, 400, "body.drum.spin") - reference::value(run, 300, "body.drum.spin"), -0.1 * 34.286 / 0.4, 0.01) << tolerance;
  }
}

}  // namespace
}  // namespace pintle
