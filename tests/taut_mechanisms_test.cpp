// Mechanisms in which geometric stiffness rules: pulled taut at their limit, or pressed with bars in line. What they are to do is found
// with steps so short that they resolve it. theory/time section 4.1.
#include <gtest/gtest.h>

#include <cstdint>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

Model taut_model(const std::string& name, double duration, double tolerance = 1e-5) {
  Model model = read_model(std::string(PINTLE_SOURCE_DIR) + "/tests/models/" + name + ".toml");
  model.simulate.duration = duration;
  model.simulate.tolerance = tolerance;
  return model;
}

Trajectory resolved(Model model, double longest) {
  model.simulate.max_step = longest;
  model.simulate.tolerance = 1e-7;
  return simulate(model);
}

// Over each joint's peak, as runs measure their own errors.
double largest_error(const Trajectory& run, const Trajectory& fine) {
  double largest = 0, worst = 0;
  for (const LoadSummary& joint : fine.joints) largest = std::max(largest, joint.peak);
  for (const LoadSummary& joint : fine.joints) {
    const std::string column = "joint." + joint.name + ".on_" + joint.second_body;
    for (std::size_t row = 0; row < fine.n_rows(); ++row) {
      const auto off = [&](const char* end) { return reference::value(run, row, column + end) - reference::value(fine, row, column + end); };
      worst = std::max(worst, std::hypot(off(".fx[world]"), off(".fy[world]")) / std::max(joint.peak, 1e-4 * largest));
    }
  }
  return worst;
}

double peak(const Trajectory& run, const std::string& joint) {
  for (const LoadSummary& of : run.joints)
    if (of.name == joint) return of.peak;
  return 0;
}

struct Case {
  const char* model;
  double duration;
  std::uint64_t steps;  // at most: twice what has been measured
  double longest;       // step of the run to compare with
};
constexpr Case kCases[] = {{"toggle_under_load", 2, 1300, 1e-3}, {"press_at_dead_centre", 2, 850, 1e-3}, {"shallow_truss", 1, 2000, 2e-4}, {"chain_pulled_taut", 0.5, 40000, 1e-4}};

TEST(TautMechanismsSlow, ForcesAreThoseOfShortSteps) {
  for (const Case& c : kCases) {
    const Model model = taut_model(c.model, c.duration);
    const Trajectory run = simulate(model), fine = resolved(model, c.longest);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << c.model << ": " << run.message;
    ASSERT_EQ(fine.outcome, Outcome::kCompleted) << c.model << ": " << fine.message;
    EXPECT_LT(run.counters.steps, c.steps) << c.model;
    EXPECT_LT(largest_error(run, fine), 1e-5) << c.model;
  }
}

// The explicit method finds 1.494053e6 N after 0.4 s too, in half a million steps. Before bodies were held, runs of 0.6 s and more took
// millions of steps and came to 1e13 N.
TEST(TautMechanismsSlow, AFourBarIsPulledTautAndLetGo) {
  for (const double duration : {0.4, 0.6, 1.0, 1.5}) {
    const Model model = taut_model("four_bar_at_its_limit", duration);
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_LT(run.counters.steps, 40000u) << duration;
    EXPECT_NEAR(peak(run, "B"), duration > 0.4 ? 1.500000e6 : 1.494053e6, 10) << duration;
    if (duration == 0.6) {
      EXPECT_LT(largest_error(run, resolved(model, 2e-5)), 1e-5);
    }
  }
}

TEST(TautMechanismsSlow, ASixBarIsPulledTautForSeconds) {
  const Trajectory short_run = simulate(taut_model("six_bar_at_its_limit", 2.4)), run = simulate(taut_model("six_bar_at_its_limit", 5));
  ASSERT_EQ(short_run.outcome, Outcome::kCompleted) << short_run.message;
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  EXPECT_NEAR(peak(short_run, "B"), 70088, 1);
  EXPECT_NEAR(peak(run, "B"), 153387, 2);
  EXPECT_LT(run.counters.steps, 220000u);
}

// With the rocker's pin in relative coordinates; what the other three then carry is 2.0e6 N.
TEST(TautMechanismsSlow, RelativeCoordinatesHoldTautBodiesAlike) {
  for (const double duration : {0.6, 1.0}) {
    Model model = taut_model("four_bar_at_its_limit", duration);
    model.simulate.equations = Equations::kRelative;
    model.joints.back().ideal = true;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    EXPECT_LT(run.counters.steps, 20000u) << duration;
    EXPECT_NEAR(peak(run, "B"), 1.99995e6, 100) << duration;
    if (duration == 0.6) {
      EXPECT_LT(largest_error(run, resolved(model, 1e-4)), 1e-5);
    }
  }
}

}  // namespace
}  // namespace pintle
