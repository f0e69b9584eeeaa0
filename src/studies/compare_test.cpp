// Differences of two runs written down by hand.
#include "pintle/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace pintle {
namespace {

// A run of one joint A with a force and a couple, and a body that moves in x and turns. Columns: t, fx, fy, m, x, angle.
Trajectory written(const std::vector<std::vector<double>>& rows) {
  Trajectory run;
  run.columns = {{"t", "s", ""}, {"joint.A.on_bar.fx[world]", "N", ""}, {"joint.A.on_bar.fy[world]", "N", ""}, {"joint.A.on_bar.m[world]", "N*m", ""},
                 {"body.bar.x", "m", ""}, {"body.bar.angle", "rad", ""}};
  for (const std::vector<double>& row : rows) run.values.insert(run.values.end(), row.begin(), row.end());
  LoadSummary joint;
  joint.name = "A";
  joint.second_body = "bar";
  joint.has_moment = true;
  run.joints = {joint};
  return run;
}

Comparison compared(const Trajectory& a, const Trajectory& b) { return compare(Model{}, a, b, Equations::kIdeal); }

TEST(ComparedRuns, ADifferenceIsThatOfTheVectors) {
  const Comparison c = compared(written({{0, 3, 4, 1, 0, 0}, {1, 0, 10, -2, 1, 0.5}}), written({{0, 0, 0, 1, 0, 0}, {1, 0, 8, -2.5, 1.25, 0.5}}));
  ASSERT_EQ(c.forces.size(), 1u);
  const Difference& force = c.forces[0];
  EXPECT_EQ(force.name, "A");
  EXPECT_EQ(force.unit, "N");
  EXPECT_DOUBLE_EQ(force.peak, 8);     // of the second run
  EXPECT_DOUBLE_EQ(force.largest, 5);  // 3 and 4 together
  EXPECT_EQ(force.largest_time, 0);
  EXPECT_DOUBLE_EQ(force.rms, std::sqrt((25 + 4) / 2.0));
  EXPECT_DOUBLE_EQ(force.relative, 5.0 / 8);
  EXPECT_DOUBLE_EQ(force.relative_rms, force.rms / 8);
  ASSERT_EQ(c.couples.size(), 1u);
  EXPECT_DOUBLE_EQ(c.couples[0].largest, 0.5);
  EXPECT_EQ(c.couples[0].largest_time, 1);
  EXPECT_DOUBLE_EQ(c.couples[0].peak, 2.5);
  ASSERT_EQ(c.coordinates.size(), 2u);
  EXPECT_EQ(c.coordinates[0].name, "body.bar.x");
  EXPECT_DOUBLE_EQ(c.coordinates[0].relative, 0.2);
  EXPECT_EQ(c.coordinates[0].digits, 0);
  EXPECT_EQ(c.coordinates[1].largest, 0);
  EXPECT_EQ(c.coordinates[1].digits, 15);
}

// A row that only one of the runs has is ignored, wherever it is; times that differ by roundoff are the same row.
TEST(ComparedRuns, OnlyCommonRowsCount) {
  const Trajectory all = written({{0, 1, 0, 0, 0, 0}, {1, 2, 0, 0, 0, 0}, {2, 3, 0, 0, 0, 0}, {3, 4, 0, 0, 0, 0}});
  const Trajectory some = written({{0.5, 99, 0, 0, 0, 0}, {1 + 1e-14, 2, 0, 0, 0, 0}, {2.5, 99, 0, 0, 0, 0}, {3, 4, 0, 0, 0, 0}, {4, 99, 0, 0, 0, 0}});
  EXPECT_EQ(compared(all, some).forces[0].largest, 0);
  EXPECT_EQ(compared(all, some).forces[0].peak, 4);
  EXPECT_EQ(compared(some, all).forces[0].largest, 0);
  const Trajectory apart = written({{0.25, 1, 0, 0, 0, 0}});
  EXPECT_EQ(compared(all, apart).forces[0].rms, 0);  // no row in common
}

// The run's own peak may lie between rows.
TEST(ComparedRuns, PeaksBetweenTheRowsCount) {
  Trajectory a = written({{0, 1, 0, 1, 0, 0}}), b = a;
  b.joints[0].peak = 20;
  b.joints[0].peak_moment = 30;
  const Comparison c = compared(a, b);
  EXPECT_EQ(c.forces[0].peak, 20);
  EXPECT_EQ(c.couples[0].peak, 30);
}

TEST(ComparedRuns, ACauseIsJudgedByBothErrors) {
  Trajectory a = written({{0, 1, 0, 1, 0, 0}}), b = written({{0, 1.5, 0, 1.25, 0, 0}});
  a.joints[0].error_estimate = 0.125;
  b.joints[0].error_estimate = 0.125;
  a.joints[0].moment_error_estimate = 0.0625;
  b.joints[0].moment_error_estimate = 0.05;
  const auto causes = [&] {
    const Comparison c = compared(a, b);
    return std::pair(c.forces[0].cause, c.couples[0].cause);
  };
  EXPECT_EQ(compared(a, b).forces[0].error_estimate, 0.25);
  EXPECT_EQ(causes(), std::pair(Cause::kNumerical, Cause::kPhysical));  // 0.5 is twice 0.25; 0.25 more than twice 0.1125
  b.joints[0].error_estimate = 0.12;
  EXPECT_EQ(causes().first, Cause::kPhysical);
  b.joints[0].unique = false;
  EXPECT_EQ(causes(), std::pair(Cause::kNotUnique, Cause::kNotUnique));
  std::swap(a, b);
  EXPECT_EQ(causes().first, Cause::kNotUnique);
}

// A force that is negligible compared with another is measured relative to a ten-thousandth of that one; a coordinate at rest relative to the moving one.
TEST(ComparedRuns, NextToNothingIsMeasuredByTheLargest) {
  Trajectory a = written({{0, 1e4, 0, 0, 2, 0}}), b = written({{0, 1e4, 0, 0, 2, 0}});
  for (Trajectory* run : {&a, &b}) {
    run->columns.push_back({"joint.B.on_bar.fx[world]", "N", ""});
    run->columns.push_back({"joint.B.on_bar.fy[world]", "N", ""});
    run->columns.push_back({"body.rest.y", "m", ""});
    run->joints.push_back(run->joints[0]);
    run->joints[1].name = "B";
    run->joints[1].has_moment = false;
  }
  a.values.insert(a.values.end(), {0.5, 0, 1e-3});
  b.values.insert(b.values.end(), {0.25, 0, 0});
  const Comparison c = compared(a, b);
  ASSERT_EQ(c.forces.size(), 2u);
  EXPECT_DOUBLE_EQ(c.forces[1].relative, 0.25 / 1.0);  // 1e-4 of 1e4
  ASSERT_EQ(c.coordinates.size(), 3u);
  EXPECT_EQ(c.coordinates[2].name, "body.rest.y");
  EXPECT_DOUBLE_EQ(c.coordinates[2].relative, 1e-3 / 2);
  ASSERT_EQ(c.couples.size(), 1u);
}

// If a quantity is zero in the second run, its difference is relative to itself.
TEST(ComparedRuns, NothingAgainstSomethingIsAllOfIt) {
  const Comparison c = compared(written({{0, 0, 0, 4, 0, 0}}), written({{0, 0, 0, 0, 0, 0}}));
  EXPECT_EQ(c.couples[0].relative, 1);
  EXPECT_EQ(c.forces[0].relative, 0);
  EXPECT_EQ(c.forces[0].digits, 15);
}

Joint joint_with(const std::string& name, std::vector<std::pair<std::string, std::vector<double>>> values, const std::string& word = "linear") {
  Joint joint;
  joint.name = name;
  joint.type = "fixed";
  joint.law.word = word;
  for (auto& [key, numbers] : values) joint.law.values[key] = numbers;
  return joint;
}

// The energy of a spring under its peak, force^2 / (2 stiffness): the smaller of two stiffnesses, the default if none is stated, plus the couple's.
TEST(ComparedRuns, SofterJointsHaveMoreOfTheEnergy) {
  Model model;
  model.joints = {joint_with("stiff", {{"stiffness", {4e6}}, {"angular_stiffness", {8}}}), joint_with("soft", {{"stiffness", {4e6, 1e6}}}),
                  joint_with("plain", {}), joint_with("rubber", {}, "maxwell")};
  Trajectory run = written({{0, 0, 0, 0, 0, 0}});
  run.joints.clear();
  for (const char* name : {"stiff", "soft", "plain", "rubber"}) {
    LoadSummary load;
    load.name = name;
    load.peak = 2e3;
    run.joints.push_back(load);
  }
  run.joints[0].has_moment = true;
  run.joints[0].peak_moment = 4;
  run.joints[1].peak_moment = 1e9;  // of a joint without a moment
  const Comparison c = compare(model, run, run, Equations::kIdeal);
  ASSERT_EQ(c.softness.size(), 3u);
  const double soft = 4e6 / 2e6, stiff = 4e6 / 8e6 + 16.0 / 16, plain = 4e6 / 2e8, all = soft + stiff + plain;
  EXPECT_EQ(c.softness[0].joint, "soft");
  EXPECT_DOUBLE_EQ(c.softness[0].share, soft / all);
  EXPECT_EQ(c.softness[1].joint, "stiff");
  EXPECT_DOUBLE_EQ(c.softness[1].share, stiff / all);
  EXPECT_EQ(c.softness[2].joint, "plain");
  EXPECT_DOUBLE_EQ(c.softness[2].share, plain / all);
}

LoadSummary load_of(const std::string& name, double peak, double mean, double rms, double error) {
  LoadSummary load;
  load.name = name;
  load.peak = peak;
  load.mean = mean;
  load.rms = rms;
  load.error_estimate = error;
  return load;
}

NamedRun run_with(const std::string& name, const std::vector<LoadSummary>& loads) {
  NamedRun run{name, {}};
  run.run.joints = loads;
  return run;
}

TEST(ComparedVariants, ChangesAreOfTheFirstRun) {
  const Variants v = compare({run_with("base", {load_of("A", 100, 50, 60, 1), load_of("tiny", 0.5, 0.1, 0.2, 1)}),
                              run_with("worn", {load_of("A", 150, 40, 60, 1), load_of("tiny", 3, 0.1, 0.2, 1), load_of("new", 7, 1, 2, 0)}),
                              run_with("alike", {load_of("A", 103, 50, 60, 1)})});
  ASSERT_EQ(v.joints.size(), 3u);
  EXPECT_EQ(v.joints[0].joint, "A");
  const std::vector<VariantLoad>& a = v.joints[0].loads;
  ASSERT_EQ(a.size(), 3u);
  EXPECT_EQ(a[0].peak_change, 0);
  EXPECT_DOUBLE_EQ(a[1].peak_change, 0.5);
  EXPECT_DOUBLE_EQ(a[1].mean_change, -0.2);
  EXPECT_EQ(a[1].rms_change, 0);
  EXPECT_EQ(a[1].cause, Cause::kPhysical);
  EXPECT_EQ(a[2].cause, Cause::kNumerical);  // 3 N, errors of 1 N each
  // A value that does not exceed its own error is no basis for a relative change.
  EXPECT_TRUE(std::isnan(v.joints[1].loads[1].peak_change));
  EXPECT_FALSE(v.joints[1].loads[2].there);
  // A joint missing in the first run.
  EXPECT_EQ(v.joints[2].joint, "new");
  EXPECT_FALSE(v.joints[2].loads[0].there);
  EXPECT_TRUE(v.joints[2].loads[1].there);
  EXPECT_TRUE(std::isnan(v.joints[2].loads[1].peak_change));
  EXPECT_EQ(v.joints[2].loads[1].cause, Cause::kNone);
}

}  // namespace
}  // namespace pintle
