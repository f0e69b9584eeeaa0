#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <cmath>
#include <limits>

#include "results/sample_run_for_tests.h"
#include "results/text_table.h"

namespace pintle {
namespace {

TEST(Engineering, FiveDigitsFixedWhereReadable) {
  EXPECT_EQ(engineering(0), "0");
  EXPECT_EQ(engineering(312.25), "312.25");
  EXPECT_EQ(engineering(-31225.4), "-31225");
  EXPECT_EQ(engineering(0.00123456), "0.0012346");
  EXPECT_EQ(engineering(999999), "999999");
  EXPECT_EQ(engineering(999999.7), "1.0000e+06");
  EXPECT_EQ(engineering(1.5e-7), "1.5000e-07");
  EXPECT_EQ(engineering(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(engineering(-std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(TextTable, AlignsAtTheDecimalPoint) {
  TextTable table;
  table.add_column("joint", TextTable::Align::kLeft);
  table.add_column("peak", TextTable::Align::kNumber, "N");
  table.add_row({"A", "312.25"});
  table.add_row({"crank", "8.5"});
  table.add_row({"über", "31225"});
  EXPECT_EQ(table.text(),
            "  joint   peak [N]\n"
            "  A         312.25\n"
            "  crank       8.5\n"
            "  über    31225\n");
}

TEST(SummaryText, SaysWhatADesignerLooksFor) {
  const std::string text = summary_text(sample::trajectory(), sample::stamp());
  for (const char* expected : {"Four-bar, section 8", "completed: 0.5 s of model time in 350 us", "312.25", "0.123",
                               "1.5e-04", "4.8e-07", "revolute", "rocker", "N*m", "18 steps (2 rejected)", "2 passes",
                               "rocker was moved by 0.2 mm", "drifts by 2.0e-05 J"})
    EXPECT_NE(text.find(expected), std::string::npos) << expected << "\n" << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(summary_text(sample::trajectory(), sample::stamp(), true).find('\x1b'), std::string::npos);
}

TEST(SummaryText, MarksJointsBeyondTheTolerance) {
  Trajectory trajectory = sample::trajectory();
  EXPECT_NE(summary_text(trajectory, {}).find("exceeds the tolerance"), std::string::npos);
  trajectory.joints[1].relative_error_estimate = 9e-6;
  EXPECT_EQ(summary_text(trajectory, {}).find("exceeds the tolerance"), std::string::npos);
  trajectory.joints[1].relative_error_estimate = std::nan("");
  EXPECT_NE(summary_text(trajectory, {}).find("exceeds the tolerance"), std::string::npos);
}

// For a chaotic motion, peaks that are not promised are marked.
TEST(SummaryText, MarksPeaksBehindTheHorizon) {
  Trajectory run = sample::trajectory();
  run.outcome = Outcome::kHorizon;
  for (LoadSummary& joint : run.joints) joint.horizon = joint.peak_time;
  EXPECT_EQ(summary_text(run, sample::stamp()).find('~'), std::string::npos);
  run.joints.front().horizon *= 0.5;
  EXPECT_NE(summary_text(run, sample::stamp()).find("~ the peak comes after"), std::string::npos);
}

// A run that was stopped before its second integration has no error estimates: they are not zero.
TEST(SummaryText, ErrorsThatWereNotEstimatedAreNoZeros) {
  Trajectory trajectory = sample::trajectory();
  trajectory.outcome = Outcome::kInterrupted;
  for (LoadSummary& joint : trajectory.joints) joint.error_estimate = joint.relative_error_estimate = 0;
  const std::string text = summary_text(trajectory, {});
  EXPECT_EQ(text.find("0.0e+00"), std::string::npos) << text;
  EXPECT_EQ(text.find("exceeds the tolerance"), std::string::npos);
}

// Percentages of the 2 J lost here. What a stiff joint loses to roundoff is not listed, nor is any joint if the loss of energy is negligible.
TEST(SummaryText, ListsTheJointsThatTurnWorkIntoHeat) {
  Trajectory trajectory = sample::trajectory();
  trajectory.energy.kinetic_peak = 10;
  trajectory.energy.dissipated = 2;
  trajectory.joints[1].heat = 1.5;
  trajectory.joints[0].heat = 1e-9;
  const std::string text = summary_text(trajectory, {});
  const std::size_t at = text.find("Heat in joints");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NE(text.find("slide     1.5000           3.0000      0.75000", at), std::string::npos) << text.substr(at);
  EXPECT_EQ(text.substr(at, text.find("\n\n", at) - at).find("O4"), std::string::npos) << text.substr(at);
  // One joint turns into heat what another has taken from its stick spring: both are listed, as fractions of the sum of their magnitudes.
  trajectory.joints[0].heat = -2.5;
  trajectory.energy.dissipated = -1;
  const std::string both = summary_text(trajectory, {});
  const std::size_t there = both.find("Heat in joints");
  ASSERT_NE(there, std::string::npos);
  EXPECT_NE(both.find("slide     1.5000           3.0000      0.37500", there), std::string::npos) << both.substr(there);
  EXPECT_NE(both.find("O4       -2.5000          -5.0000     -0.62500", there), std::string::npos) << both.substr(there);
  trajectory.energy.kinetic_peak = 1e7;
  EXPECT_EQ(summary_text(trajectory, {}).find("Heat in joints"), std::string::npos);
}

// For a joint that has stops and clearance, each kind of event has its own approach speed and the heat of its own events.
TEST(SummaryText, ListsEventsWithTheirFastestApproachAndMostHeat) {
  Trajectory run = sample::trajectory();
  run.events = {{"O2",
                 {{"penetration", "m", ""}, {"approach_speed", "m/s", ""}, {"stop_approach_speed", "rad/s", ""}, {"heat", "J", ""}},
                 {{0.125, "touch", {7e-5, 0.25, 3, 0}}, {0.25, "let-go", {7e-5, 0, 3, 0.0625}}, {0.375, "touch", {7e-5, 0.5, 3, 0}}, {0.5, "touches upper stop", {7e-5, 8, 2.75, 0.03125}}, {0.625, "let-go", {7e-5, 0, 3, 0.75}}}}};
  const std::string text = summary_text(run, {});
  const auto line_of = [&text](const std::string& kind) {
    const std::size_t at = text.find("  O2      " + kind);
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  };
  const std::string touch = line_of("touch "), let_go = line_of("let-go"), stop = line_of("touches upper stop");
  for (const char* expected : {" 2 ", "0.125", "0.375", "0.5", "m/s"}) EXPECT_NE(touch.find(expected), std::string::npos) << expected << "\n" << text;
  for (const char* expected : {" 2 ", "0.25", "0.625", "0.75"}) EXPECT_NE(let_go.find(expected), std::string::npos) << expected << "\n" << text;
  for (const char* expected : {" 1 ", "2.75", "rad/s", "0.03125"}) EXPECT_NE(stop.find(expected), std::string::npos) << expected << "\n" << text;
}

TEST(SummaryText, EachEndOfAGuideHasItsOwnApproach) {
  Trajectory run = sample::trajectory();
  run.events = {{"G", {{"approach_speed_front", "m/s", ""}, {"approach_speed_rear", "m/s", ""}, {"heat", "J", ""}},
                 {{0.125, "front touch", {0.25, 0.75, 0}}, {0.25, "rear touch", {0.25, 0.5, 0}}, {0.5, "rear let-go", {0.25, 0, 0}}}}};
  const std::string text = summary_text(run, {});
  const auto line_of = [&text](const std::string& kind) { return text.substr(text.find(kind), text.find('\n', text.find(kind)) - text.find(kind)); };
  EXPECT_NE(line_of("front touch").find("0.25000   m/s"), std::string::npos) << text;
  EXPECT_NE(line_of("rear touch").find("0.50000   m/s"), std::string::npos) << text;
  EXPECT_EQ(line_of("rear let-go").find("m/s"), std::string::npos) << text;
}

TEST(SummaryText, EmptyTrajectoryIsNoAccident) {
  EXPECT_NE(summary_text({}, {}).find("completed"), std::string::npos);
}

TEST(SummaryText, ALongListIsCutToItsLargest) {
  Trajectory trajectory;
  trajectory.tolerance = 1e-3;
  for (int j = 0; j < 300; ++j) {
    LoadSummary& load = trajectory.joints.emplace_back();
    load.name = "pin" + std::to_string(j);
    load.peak = (j * 7) % 300;
    if (j == 1) load.relative_error_estimate = 0.1;  // not among the largest
    trajectory.notes.push_back("note of " + load.name + ".");
  }
  const std::string text = summary_text(trajectory, {});
  EXPECT_NE(text.find("the largest 20 of 300"), std::string::npos);
  EXPECT_NE(text.find("1 joints, the worst is pin1"), std::string::npos);
  EXPECT_NE(text.find("  pin257 "), std::string::npos);  // 257 * 7 = 299 modulo 300
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 70);
  trajectory.joints.resize(150);
  EXPECT_NE(summary_text(trajectory, {}).find("  pin0 "), std::string::npos);
}

}  // namespace
}  // namespace pintle
