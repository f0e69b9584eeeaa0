// A slider-crank with a worn pin: where the pin is at the start, and motions that repeat with the crank as against motions that never do. theory/contact
// section 9.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
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

double& restitution_of_b(Model& model) {
  for (Joint& joint : model.joints)
    if (joint.name == "B") return joint.law.values["restitution"].front();
  throw std::logic_error("no joint B");
}

// The other joints deflect by more than the smaller clearances; the pin is left in the middle nevertheless.
TEST(ClearanceRegimes, ThePinStartsInTheMiddleOfItsPlay) {
  for (const double clearance : {5e-4, 5e-5, 2e-5}) {
    Model model = worn(clearance, "lankarani-nikravesh", 5000, 1e-4);
    const Trajectory run = simulate(model);
    EXPECT_NEAR(reference::value(run, 0, "joint.B.penetration"), -clearance, 1e-3 * clearance);
    EXPECT_EQ(reference::value(run, 0, "joint.B.contact_force"), 0);
  }
}

// At 5000 rpm inertia presses the pin against its bush once the start has died away, and every turn repeats the previous one.
TEST(ClearanceRegimes, AFastCrankMakesThePinRepeatItsOrbit) {
  for (const std::string contact_model : {"lankarani-nikravesh", "hunt-crossley", "flores"})
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
      ASSERT_EQ(run.events.size(), 1u);
      const std::vector<JointEvent>& events = run.events[0].events;
      const long touches = std::count_if(events.begin(), events.end(), [](const JointEvent& event) { return event.what == "touch"; });
      EXPECT_TRUE(touches == 3 || touches == 4) << touches << ", " << contact_model << ", " << clearance;
      EXPECT_EQ(events.back().what, "touch") << contact_model << ", " << clearance;  // and stays
      EXPECT_EQ(run.growth.rate, 0);
    }
}

// At 600 rpm it flies and strikes without end: neighbouring orbits separate by a factor of e in about a third of a turn. Rates found over half a second scatter: eleven runs at each
// clearance whose restitutions differ by 1e-9 give 26 to 59 per second at 0.1 mm and 13 to 47 at 0.2 mm, 30 in the middle, and state errors of 27 to 60 % of them.
TEST(ClearanceRegimesSlow, ASlowCrankMakesItChaotic) {
  constexpr double kMiddle = 30, kLeast = 10, kMost = 70, kErrors = 2.5;  // [1/s]; the last: in stated errors, at most
  for (const double clearance : {1e-4, 2e-4})
    for (const double restitution : {0.0, 1e-9, -1e-9}) {
      Model model = worn(clearance, "lankarani-nikravesh", 600, 20);
      restitution_of_b(model) += restitution;
      const Trajectory run = simulate(model);
      ASSERT_EQ(run.outcome, Outcome::kHorizon) << clearance << ": " << run.message;
      EXPECT_GT(run.growth.rate, kLeast) << clearance;
      EXPECT_LT(run.growth.rate, kMost) << clearance;
      EXPECT_NEAR(run.growth.rate, kMiddle, kErrors * run.growth.rate_error) << clearance;
      EXPECT_LT(run.growth.rate_error, 0.75 * run.growth.rate) << clearance;
    }
}

// With the other law, too: 19 to 43 per second in runs that differ by next to nothing. Two single integrations with restitutions that differ by 1e-11 separate
// equally fast, within the scatter of such rates over half a second.
TEST(ClearanceRegimesSlow, FloresLawPartsOrbitsAsWell) {
  const Trajectory run = simulate(worn(1e-4, "flores", 600, 20));
  ASSERT_EQ(run.outcome, Outcome::kHorizon) << run.message;
  EXPECT_NEAR(run.growth.rate, 28, 1.5 * run.growth.rate_error);
  EXPECT_LT(run.growth.rate_error, 0.5 * run.growth.rate);
  Model model = worn(1e-4, "flores", 600, 6);
  Trajectory orbit, neighbour;
  reference::integrate_once(model, 1e-6, 3, nullptr, &orbit);
  restitution_of_b(model) *= 1 + 1e-11;
  reference::integrate_once(model, 1e-6, 3, nullptr, &neighbour);
  double n = 0, t = 0, y = 0, tt = 0, ty = 0;  // the slope of the logarithm of their distance
  for (std::size_t row = 61; row < orbit.n_rows(); ++row) {
    const auto apart = [&](const char* column) { return reference::value(orbit, row, column) - reference::value(neighbour, row, column); };
    const double at = orbit.at(row, 0), distance = std::log(std::hypot(apart("body.rod.y"), apart("body.slider.x")));
    ++n;
    t += at;
    y += distance;
    tt += at * at;
    ty += at * distance;
  }
  EXPECT_NEAR((n * ty - t * y) / (n * tt - t * t), run.growth.rate, 2 * std::hypot(run.growth.rate_error, run.growth.rate_error));
}

// Up to the horizon, forces are those of a run that is accurate for longer. After it, peaks, means and RMS are statistics, which another orbit shares within their stated
// scatter.
TEST(ClearanceRegimesSlow, ChaoticForcesArePromisedUpToTheHorizonAndStatisticsBehindIt) {
  Model model = worn(1e-4, "flores", 600, 20);
  const Trajectory run = simulate(model);
  Model first = worn(1e-4, "flores", 600, 2.5);
  first.simulate.tolerance = 1e-5;
  const Trajectory fine = reference::completed(first);
  restitution_of_b(model) *= 1 + 1e-9;
  const Trajectory other = simulate(model);
  ASSERT_EQ(run.outcome, Outcome::kHorizon) << run.message;
  ASSERT_EQ(other.outcome, Outcome::kHorizon) << other.message;
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    const LoadSummary &joint = run.joints[j], &again = other.joints[j];
    const std::string column = joint.name + ".on_" + joint.second_body;
    double error = 0, peak = 0;
    EXPECT_GT(joint.horizon, 0.05) << joint.name;  // 0.085 to 0.5 s in runs that differ by next to nothing
    EXPECT_LT(joint.horizon, 1) << joint.name;
    for (std::size_t row = 0; row < fine.n_rows() && run.at(row, 0) <= joint.horizon; ++row) {
      const double x = reference::value(fine, row, "joint." + column + ".fx[world]"), y = reference::value(fine, row, "joint." + column + ".fy[world]");
      error = std::max(error, reference::force_error(run, row, column, x, y));
      peak = std::max(peak, std::hypot(x, y));
    }
    EXPECT_LE(error, model.simulate.tolerance * peak) << joint.name;
    EXPECT_GT(joint.peak_after, joint.rms_after);
    EXPECT_GT(joint.rms_after, joint.mean_after);
    EXPECT_GT(joint.mean_after, 0);
    EXPECT_NE(joint.rms_after, again.rms_after);
    EXPECT_NEAR(joint.rms_after, again.rms_after, 3 * std::max(joint.rms_scatter, again.rms_scatter)) << joint.name;
    EXPECT_NEAR(joint.mean_after, again.mean_after, 3 * std::max(joint.mean_scatter, again.mean_scatter)) << joint.name;
  }
}

// Impact forces separate at once and are no guide to the growth of errors; positions are. The horizon is that of the finest passes. After passes that are too coarse,
// which separate no later than coarser ones, it would be a tenth as long.
TEST(ClearanceRegimesSlow, PinsThatBounceArePromisedAsLongAsFinePassesAgree) {
  struct Case {
    const char* model;
    double earliest;  // horizon [s]
    double checked;   // duration of the finer run [s]
  };
  for (const Case& c : {Case{"two_bouncing_pins", 0.1, 0.12}, {"rattling_ball_bearing", 0.01, 0.024}}) {
    const Trajectory run = simulate(reference::test_model(c.model));
    ASSERT_EQ(run.outcome, Outcome::kHorizon) << c.model << ": " << run.message;
    ASSERT_GT(run.growth.horizon, c.earliest) << c.model;
    Model first = reference::test_model(c.model);
    first.simulate.duration = c.checked;
    first.simulate.tolerance = 1e-5;
    const Trajectory fine = reference::completed(first);
    for (const LoadSummary& joint : run.joints) {
      const std::string column = joint.name + ".on_" + joint.second_body;
      double error = 0, peak = 0;
      for (std::size_t row = 0; row < fine.n_rows() && run.at(row, 0) <= joint.horizon; ++row) {
        const double x = reference::value(fine, row, "joint." + column + ".fx[world]"), y = reference::value(fine, row, "joint." + column + ".fy[world]");
        error = std::max(error, reference::force_error(run, row, column, x, y));
        peak = std::max(peak, std::hypot(x, y));
      }
      EXPECT_LE(error, run.tolerance * peak) << c.model << ", " << joint.name;
    }
  }
}

}  // namespace
}  // namespace pintle
