// The comparison of methods: its error measures on synthetic signals, and a pendulum with known answers.
#include "pintle/solvers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "studies/joint_errors.h"
#include "system/sample_systems_for_tests.h"

namespace pintle {
namespace {

// A trajectory of one joint "J" on "b", force (fx, 0), and a body at (x, 0) turned by `angle`.
Trajectory made_up(double (*fx)(double), double x, double angle) {
  Trajectory t;
  for (const char* name : {"t", "body.b.x", "body.b.y", "body.b.angle", "joint.J.on_b.fx[world]", "joint.J.on_b.fy[world]"})
    t.columns.push_back({name, "", ""});
  for (int i = 0; i <= 1000; ++i) {
    const double time = 1e-3 * i;
    t.values.insert(t.values.end(), {time, x, 0, angle, fx(time), 0});
  }
  LoadSummary joint;
  joint.name = "J";
  joint.second_body = "b";
  t.joints = {joint};
  return t;
}
double steady(double) { return -20; }
double drifting(double t) { return -20 + 3 * t; }
double shaking(double t) { return -20 + 3 * t + 0.5 * std::sin(2 * 3.14159265358979 * 100 * t); }

TEST(JointErrors, SmoothDriftIsNoVibration) {
  const Trajectory truth = made_up(steady, 1, 0.2);
  const JointErrors errors(truth, 1);
  const Trajectory drift = made_up(drifting, 1, 0.2);
  EXPECT_NEAR(errors.vibration(drift, 20).absolute, 0, 1e-12);
  EXPECT_NEAR(errors.force_error(drift).relative, 3.0 / 20, 1e-12);
  EXPECT_EQ(errors.force_error(drift).joint, "J");
}

// The mean over an odd number of rows about two periods long contains almost none of the vibration.
TEST(JointErrors, VibrationIsMeasuredFromPeakToPeak) {
  const Trajectory truth = made_up(steady, 1, 0.2);
  const JointErrors::Worst v = JointErrors(truth, 1).vibration(made_up(shaking, 1, 0.2), 10);
  EXPECT_NEAR(v.absolute, 1.0, 0.06);
  EXPECT_NEAR(v.relative, v.absolute / 20, 1e-12);
}

TEST(JointErrors, PositionsAndAngles) {
  const Trajectory truth = made_up(steady, 1, 0.2);
  const auto errors = JointErrors(truth, 1).position_errors(made_up(steady, 1.003, 0.19));
  EXPECT_NEAR(errors[0], 0.003, 1e-12);
  EXPECT_NEAR(errors[1], 0.01, 1e-12);
  EXPECT_EQ(JointErrors(truth, 1).force_error(truth).relative, 0);
}

TEST(JointErrors, ShortSeriesHaveNoVibration) {
  EXPECT_EQ(peak_to_peak_of_fast_part({}, 3), 0);
  EXPECT_EQ(peak_to_peak_of_fast_part({1, 2}, 3), 0);
  EXPECT_NEAR(peak_to_peak_of_fast_part({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0}, 1), 2 * (2.0 / 3), 1e-12);
}

Model stiff_pendulum() {
  Model model = sample::pendulum(1e6, 500);
  model.simulate.duration = 0.2;
  model.simulate.output_step = 1e-3;
  return model;
}

TEST(CompareSolvers, ErrorsFallWithTheTolerance) {
  SolverStudyOptions options;
  options.methods = {"radau", "ode23t", "hht"};
  options.tolerances = {1e-3, 1e-5, 1e-7};
  const SolverStudy study = compare_solvers(stiff_pendulum(), options);
  EXPECT_TRUE(study.truth.complete);
  EXPECT_LT(study.truth.error_estimate, 1e-8);
  ASSERT_EQ(study.runs.size(), 9U);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const SolverRun& run = study.runs[i];
    EXPECT_EQ(run.end, SolverEnd::kCompleted) << run.message;
    EXPECT_EQ(run.worst_joint, "pin");
    EXPECT_EQ(run.t_end, 0.2);
    EXPECT_GT(run.evaluations, run.steps);
    if (i % 3 == 0) continue;
    EXPECT_LT(run.force_error, study.runs[i - 1].force_error);
    EXPECT_LT(run.position_error, study.runs[i - 1].position_error);
    EXPECT_TRUE(run.method == "radau" || run.steps > study.runs[i - 1].steps);
  }
  // Methods with a tolerance on positions have far less accurate joint forces.
  EXPECT_LT(study.runs[1].force_error, 1e-2 * study.runs[4].force_error);
  ASSERT_EQ(study.orders.size(), 3U);
  EXPECT_GT(study.orders[1].order, 1.5);
}

TEST(CompareSolvers, TimeIsLimited) {
  Model model = stiff_pendulum();
  SolverStudyOptions options;
  options.methods = {"dopri5"};
  options.tolerances = {1e-5};
  options.time_limit = 1e-4;
  const SolverStudy study = compare_solvers(model, options);
  ASSERT_EQ(study.runs.size(), 1U);
  EXPECT_EQ(study.runs[0].end, SolverEnd::kOutOfTime);
  EXPECT_EQ(study.runs[0].message, "more than 0.0001 s");
  EXPECT_TRUE(std::isnan(study.runs[0].force_error));
  EXPECT_LT(study.runs[0].t_end, 0.2);
  EXPECT_TRUE(std::isnan(study.orders[0].order));
}

TEST(CompareSolvers, StopsWhenAsked) {
  int calls = 0;
  const SolverStudy study = compare_solvers(stiff_pendulum(), {}, [&calls] { return ++calls < 50; });
  EXPECT_TRUE(study.interrupted);
}

TEST(CompareSolvers, RefusesWhatMakesNoSense) {
  SolverStudyOptions options;
  options.methods = {"euler"};
  EXPECT_THROW(compare_solvers(stiff_pendulum(), options), std::invalid_argument);
  options = {};
  options.tolerances = {0};
  EXPECT_THROW(compare_solvers(stiff_pendulum(), options), std::invalid_argument);
  options = {};
  options.methods = {"penalty"};
  EXPECT_THROW(compare_solvers(stiff_pendulum(), options), std::invalid_argument);
  Model relative = stiff_pendulum();
  relative.simulate.equations = Equations::kRelative;
  EXPECT_THROW(compare_solvers(relative, {}), std::invalid_argument);
}

// Seven methods of enforcing the same constraints, against the first at a tighter tolerance.
TEST(CompareSolvers, WaysToKeepConstraints) {
  Model ideal = stiff_pendulum();
  ideal.simulate.equations = Equations::kIdeal;
  SolverStudyOptions options;
  options.tolerances = {1e-4, 1e-6};
  const SolverStudy study = compare_solvers(ideal, options);
  ASSERT_EQ(study.runs.size(), 14U);
  EXPECT_DOUBLE_EQ(study.window, 20 * study.output_step);  // ideal joints do not vibrate: no period is longer
  const std::vector<std::string> words = solver_methods(Equations::kIdeal);
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const SolverRun& run = study.runs[i];
    EXPECT_EQ(run.method, words[i / 2]);
    ASSERT_EQ(run.end, SolverEnd::kCompleted) << run.method << run.message;
    EXPECT_LT(run.force_error, i % 2 == 0 ? 1e-2 : 1e-4) << run.method;
  }
}

}  // namespace
}  // namespace pintle
