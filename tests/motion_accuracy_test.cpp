// A tolerance on the motion: positions are as accurate as asked for and as stated, and vibrations that do not affect them are stepped over. The truth is a run
// with a far smaller tolerance on the forces, which follows every vibration.
#include <gtest/gtest.h>

#include "tests/reference_tables.h"

namespace pintle {
namespace {

// The angle that matters is the crank's: in these mechanisms no point is off by more than its error times the longest arm.
struct Coordinate {
  const char* name;
  const char* column;
  double duration;
};

void PrintTo(const Coordinate& c, std::ostream* out) { *out << c.name; }

Trajectory run_with(const Coordinate& c, ToleranceOf of, double tolerance) {
  Model model = reference::mechanism(c.name);
  model.simulate.duration = c.duration;
  model.simulate.output_step = c.duration / 50;
  model.simulate.tolerance_of = of;
  model.simulate.tolerance = tolerance;
  return simulate(model);
}

double column_difference(const Trajectory& a, const Trajectory& b, const char* column) {
  double worst = 0;
  for (std::size_t row = 0; row < a.n_rows(); ++row) worst = std::max(worst, std::abs(reference::value(a, row, column) - reference::value(b, row, column)));
  return worst;
}

class MotionAccuracy : public testing::TestWithParam<Coordinate> {};

TEST_P(MotionAccuracy, IsAsAskedForAndAsStated) {
  const Coordinate c = GetParam();
  const Trajectory truth = run_with(c, ToleranceOf::kForces, 1e-7);
  ASSERT_EQ(truth.outcome, Outcome::kCompleted) << truth.message;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const Trajectory run = run_with(c, ToleranceOf::kMotion, tolerance);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << tolerance << ": " << run.message;
    EXPECT_TRUE(run.of_motion);
    EXPECT_LE(run.motion_error, tolerance);
    const double error = column_difference(run, truth, c.column);  // for a path of one or two lengths
    EXPECT_LE(error, 3 * tolerance);
    EXPECT_LE(error, 10 * run.motion_error + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, MotionAccuracy,
                         testing::Values(Coordinate{"pendulum", "body.rod.x", 4}, Coordinate{"four_bar", "body.coupler.x", 1}, Coordinate{"n_four_bar_1", "body.crank0.x", 2},
                                         Coordinate{"inverted_slider_crank", "body.crank.x", 1}),
                         [](const auto& one) { return std::string(one.param.name); });

// At 2.9 s the machine stops and the car swings on its ropes, within one long step if nobody looks at what this step leaves out.
TEST(MotionAccuracyBehindAnEvent, HoldsInEveryRow) {
  Model model = reference::mechanism("goods_lift");
  model.simulate.tolerance_of = ToleranceOf::kMotion;
  const auto at = [&model](double tolerance) {
    model.simulate.tolerance = tolerance;
    return simulate(model);
  };
  const Trajectory run = at(3e-5), truth = at(1e-7);
  ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
  ASSERT_EQ(truth.outcome, Outcome::kCompleted) << truth.message;
  const double path = std::abs(reference::value(truth, truth.n_rows() - 1, "body.car.y") - reference::value(truth, 0, "body.car.y"));
  EXPECT_GT(path, 9);
  EXPECT_LT(column_difference(run, truth, "body.car.y"), 3e-5 * path);
}

TEST(MotionAccuracySteps, AreThoseOfTheMotion) {
  const Coordinate many{"n_four_bar_10", "body.crank0.x", 4};
  const Trajectory forces = run_with(many, ToleranceOf::kForces, 1e-3), motion = run_with(many, ToleranceOf::kMotion, 1e-3);
  ASSERT_EQ(motion.outcome, Outcome::kCompleted) << motion.message;
  EXPECT_LT(motion.counters.steps * 5, forces.counters.steps);
  EXPECT_LE(column_difference(motion, forces, many.column), 3e-3);
}

TEST(MotionAccuracySteps, StiffnessDoesNotMatter) {
  std::uint64_t least = 0, most = 0;
  for (const double k : {1e6, 1e8, 1e10, 1e12}) {
    Model model = reference::mechanism("n_four_bar_1");
    for (Joint& joint : model.joints) joint.law.values["stiffness"] = {k};
    model.simulate.duration = 2;
    model.simulate.tolerance_of = ToleranceOf::kMotion;
    model.simulate.tolerance = 1e-3;
    const Trajectory run = simulate(model);
    ASSERT_EQ(run.outcome, Outcome::kCompleted) << run.message;
    const std::uint64_t of_a_pass = run.counters.steps / run.counters.passes;
    std::printf("  k = %.0e: %d steps in %d passes\n", k, static_cast<int>(run.counters.steps), static_cast<int>(run.counters.passes));
    EXPECT_LE(run.counters.passes, 4u);
    least = least == 0 ? of_a_pass : std::min(least, of_a_pass);
    most = std::max(most, of_a_pass);
  }
  EXPECT_LT(2 * most, 3 * least);
}

// The guide carries the weight, whatever the slide does on it: no joint force shows that the motion is lost.
TEST(MotionNote, AMotionThatNoJointForceShowsIsNamed) {
  const auto names_it = [](const Trajectory& run) {
    return std::any_of(run.notes.begin(), run.notes.end(), [](const std::string& note) { return note.find("tolerance_of = \"motion\"") != std::string::npos; });
  };
  const Trajectory lost = simulate(reference::test_model("duffing_slide"));
  EXPECT_EQ(lost.outcome, Outcome::kCompleted) << lost.message;
  EXPECT_TRUE(names_it(lost));
  EXPECT_FALSE(names_it(simulate(reference::test_model("duffing_slide", {"simulate.tolerance_of=\"motion\"", "simulate.duration=5"}))));
  EXPECT_FALSE(names_it(simulate(reference::mechanism("four_bar"))));
  EXPECT_FALSE(names_it(simulate(reference::test_model("seat_post_with_play"))));  // it stays where it is
}

}  // namespace
}  // namespace pintle
