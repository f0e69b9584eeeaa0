// A slider-crank with a worn pin: where the pin stands at the start, and motions that repeat with the crank beside motions that never do.
// theory/contact section 9.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

Model worn(double clearance, const std::string& contact_model, double rpm, double turns) {
  Model model = reference::mechanism("slider_crank_clearance", {fmt::format("parameters.speed=\"{} rpm\"", rpm), fmt::format("joint.B.clearance={}", clearance),
                                                                "joint.B.contact_model=" + contact_model});
  model.simulate.duration = turns * 60 / rpm;
  model.simulate.output_step = 60 / rpm / 60;
  return model;
}

// The other joints give way by more than the smaller clearances; the pin is left in the middle all the same.
TEST(ClearanceRegimes, ThePinStartsInTheMiddleOfItsPlay) {
  for (const double clearance : {5e-4, 5e-5, 2e-5}) {
    Model model = worn(clearance, "lankarani-nikravesh", 5000, 1e-4);
    const Trajectory run = simulate(model);
    EXPECT_NEAR(reference::value(run, 0, "joint.B.penetration"), -clearance, 1e-3 * clearance);
    EXPECT_EQ(reference::value(run, 0, "joint.B.contact_force"), 0);
  }
}

// At 5000 rpm inertia presses the pin against its bush once the start has died away, and every turn is like the one before.
TEST(ClearanceRegimes, AFastCrankMakesThePinRepeatItsOrbit) {
  for (const std::string contact_model : {"lankarani-nikravesh", "hunt-crossley"})
    for (const double clearance : {5e-4, 1e-4}) {
      const Trajectory run = simulate(worn(clearance, contact_model, 5000, 12));
      ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
      for (const char* column : {"joint.B.penetration", "joint.B.contact_force", "body.crank.spin"}) {
        double size = 0, change = 0;
        for (std::size_t row = run.n_rows() - 61; row < run.n_rows(); ++row) {
          size = std::max(size, std::abs(reference::value(run, row, column)));
          change = std::max(change, std::abs(reference::value(run, row, column) - reference::value(run, row - 60, column)));
        }
        EXPECT_LT(change, 1e-4 * size) << column << ", " << contact_model << ", " << clearance;
      }
    }
}

// At 600 rpm it flies and strikes without end: neighbouring orbits part by a factor of e in less than a third of a turn.
TEST(ClearanceRegimesSlow, ASlowCrankMakesItChaotic) {
  for (const double clearance : {1e-4, 2e-4}) {
    const Trajectory run = simulate(worn(clearance, "lankarani-nikravesh", 600, 20));
    ASSERT_EQ(run.outcome, Outcome::kHorizon) << clearance << ": " << run.message;
    EXPECT_GT(run.growth.rate, 20) << clearance;
    EXPECT_LT(run.growth.rate, 60) << clearance;
    EXPECT_LT(run.growth.rate_error, 0.3 * run.growth.rate) << clearance;
  }
}

}  // namespace
}  // namespace pintle
