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

}  // namespace
}  // namespace pintle
