// Between two touches a mechanism is driven, sprung or thrown. The accuracy of the flight decides when it ends, and with it every force of a blow that lasts a millisecond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// The largest difference of a joint's force, relative to its peak.
double largest_difference(const Trajectory& run, const Trajectory& truth, const LoadSummary& joint) {
  const std::string column = "joint." + joint.name + ".on_" + joint.second_body;
  double largest = 0;
  for (std::size_t row = 0; row < run.n_rows(); ++row) {
    double square = 0;
    for (const char* axis : {".fx[world]", ".fy[world]"}) {
      const std::string name = column + axis;
      square += std::pow(reference::value(run, row, name) - reference::value(truth, row, name), 2);
    }
    largest = std::max(largest, std::sqrt(square));
  }
  return largest / joint.peak;
}

// The hand's spring goes through half a period in a flight that every pass makes in one step. All passes were late by 25 ns, and off by 38 times the tolerance.
TEST(ContactFlights, EndInTimeAlthoughEveryPassMakesThemInOneStep) {
  for (const char* equations : {"newtonian", "relative"})
    for (const char* onset : {"0.018", "0.02", "0.022"}) {
      Model model = reference::test_model("shift_fork", {"motor.hand.torque=150 N*m/rad*(4 deg*smoothstep(" + std::string(onset) + " s,0.2 s,t) - angle - 90 deg) - 0.5 N*m*s/rad*angle_rate",
                                                         "simulate.equations=" + std::string(equations)});
      const Trajectory run = reference::completed(model);
      model.simulate.max_step = 5e-4;
      const Trajectory truth = reference::completed(model);
      ASSERT_EQ(run.n_rows(), truth.n_rows());
      for (const LoadSummary& joint : run.joints) EXPECT_LE(largest_difference(run, truth, joint), run.tolerance) << joint.name << ", onset at " << onset << " s, " << equations;
    }
}

// A gap without force is that of the bodies' positions: its curve is not integrated. With it, steps followed the spline of each tooth, and there were 74,000 of them.
TEST(ContactFlights, TeethThatPassWithoutTouchingCostNoSteps) {
  const Trajectory run = reference::completed(reference::test_model("toothed_wheel_beside_a_pin"));
  EXPECT_EQ(run.counters.events, 0U);
  EXPECT_LT(run.counters.steps, 3000U);
}

}  // namespace
}  // namespace pintle
