// Loops, mobility, redundancy, gears: mechanisms that can be solved by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "check/check_samples_for_tests.h"
#include "pintle/check.h"

namespace pintle {
namespace {

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> members(const CheckRedundancy& group) {
  std::vector<std::string> names;
  for (const auto& m : group.members) names.push_back(m.joint + "." + m.component);
  return sorted(names);
}

TEST(CheckMobility, FourBarHasOneFreedomAndOneLoop) {
  const CheckReport report = check_model(checked::four_bar(1, 4, 4, 6, 60 * kDegree));
  EXPECT_EQ(report.mobility.freedoms, 9);
  EXPECT_EQ(report.mobility.constraints, 8);
  EXPECT_EQ(report.mobility.gruebler, 1);
  EXPECT_EQ(report.mobility.rank, 8);
  EXPECT_EQ(report.mobility.mobility, 1);
  EXPECT_EQ(report.mobility.redundant, 0);
  EXPECT_FALSE(report.mobility.singular_position());
  EXPECT_TRUE(report.redundancies.empty());
  ASSERT_EQ(report.topology.n_loops, 1);
  EXPECT_EQ(sorted(report.topology.loops[0].joints), (std::vector<std::string>{"A", "B", "O2", "O4"}));
  EXPECT_TRUE(report.topology.floating.empty());
  EXPECT_DOUBLE_EQ(report.total_mass, 9);
  EXPECT_TRUE(report.passed());
}

// The third crank adds two constraints but forbids nothing new: forces along the cranks, (1, -2, 1), balance by
// themselves. At A it acts along the crank's own x axis alone, at O the ground's x and y axes share it.
TEST(CheckMobility, ParallelogramMovesAgainstGrueblersCount) {
  for (const double error : {0.0, 1e-5}) {
    const CheckReport report = check_model(checked::five_bar_parallelogram(error));
    EXPECT_EQ(report.mobility.gruebler, 0) << error;
    EXPECT_EQ(report.mobility.mobility, 1) << error;
    EXPECT_EQ(report.mobility.redundant, 1) << error;
    EXPECT_EQ(report.mobility.servos, 1);
    EXPECT_EQ(report.mobility.mobility_driven, 0);
    EXPECT_EQ(report.topology.n_loops, 2);
    ASSERT_EQ(report.redundancies.size(), 1u) << error;
    EXPECT_EQ(report.redundancies[0].degree, 1);
    EXPECT_EQ(members(report.redundancies[0]),
              (std::vector<std::string>{"A1.x", "A2.x", "A3.x", "O1.x", "O1.y", "O2.x", "O2.y", "O3.x", "O3.y"}));
    EXPECT_EQ(report.redundancies[0].members[0].joint, "A2");  // twice the force of the outer cranks
    double shares = 0;
    for (const auto& m : report.redundancies[0].members) shares += m.share;
    EXPECT_NEAR(shares, 1, 1e-4);
    EXPECT_TRUE(report.passed());
  }
}

// All bars in one line: at this instant the links may move in two ways, slightly further on they cannot.
TEST(CheckMobility, ChangePointIsASingularPosition) {
  const CheckReport report = check_model(checked::four_bar(1, 3, 1, 3, 0));
  EXPECT_EQ(report.mobility.rank, 7);
  EXPECT_EQ(report.mobility.rank_nearby, 8);
  EXPECT_TRUE(report.mobility.singular_position());
  EXPECT_EQ(report.mobility.mobility, 1);
  EXPECT_EQ(report.mobility.redundant, 0);
  EXPECT_TRUE(report.redundancies.empty()) << "none nearby";
}

TEST(CheckMobility, BodiesWithoutGroundAreNamed) {
  Model model = checked::pendulum();
  model.bodies.push_back(checked::bar("loose", 1, 1, {3, 0}, 0, {{"a", {0, 0}, 0}}));
  const CheckReport report = check_model(model);
  EXPECT_EQ(report.topology.floating, (std::vector<std::vector<std::string>>{{"loose"}}));
  EXPECT_EQ(report.topology.n_loops, 0);
  EXPECT_EQ(report.mobility.mobility, 4);
}

// Two joints between the same two bodies form a loop of two. Two pins have 4 constraints on 3 degrees of freedom,
// with rank 3.
TEST(CheckMobility, TwoPinsOnOneBodyAreOneTooMany) {
  Model model = checked::pendulum();
  model.ground.push_back({"tip", {0, 1}, 0});
  model.bodies[0].markers.push_back({"tip", {0.5, 0}, 0});
  model.joints.push_back(checked::joint("tip", "revolute", {"ground", "tip"}, {"rod", "tip"}));
  const CheckReport report = check_model(model);
  EXPECT_EQ(report.mobility.gruebler, -1);
  EXPECT_EQ(report.mobility.mobility, 0);
  EXPECT_EQ(report.mobility.redundant, 1);
  ASSERT_EQ(report.redundancies.size(), 1u);
  EXPECT_EQ(members(report.redundancies[0]), (std::vector<std::string>{"pin.y", "tip.y"}));  // along the bar
  ASSERT_EQ(report.topology.n_loops, 1);
  EXPECT_EQ(sorted(report.topology.loops[0].joints), (std::vector<std::string>{"pin", "tip"}));
}

TEST(CheckGears, RatiosOfPairsAndOfTheTrain) {
  const CheckReport report = check_model(checked::gear_train());
  EXPECT_EQ(report.mobility.mobility, 1);
  EXPECT_EQ(report.mobility.redundant, 0);
  EXPECT_EQ(report.topology.n_loops, 2);
  ASSERT_EQ(report.gears.size(), 2u);
  EXPECT_NEAR(report.gears[0].ratio, -1.0 / 3, 1e-12);
  EXPECT_NEAR(report.gears[1].ratio, -0.025, 1e-12);  // counter-clockwise: its left side goes down
  EXPECT_EQ(report.gears[1].unit, "m/rad");
  EXPECT_EQ(report.transmission_of, "O1.angle");
  ASSERT_EQ(report.transmission.size(), 2u);
  EXPECT_NEAR(report.transmission[0].ratio, -1.0 / 3, 1e-9);
  EXPECT_NEAR(report.transmission[1].ratio, 0.025 / 3, 1e-9);
  EXPECT_EQ(report.transmission[1].unit, "m/rad");
}

// A ladder of parallelograms, large enough for the sparse method: each loop is one constraint short of Gruebler's
// count.
TEST(CheckMobility, LargeMechanismsAgreeWithSmallOnes) {
  Model model = checked::five_bar_parallelogram(0);
  const Model one = model;
  for (int copy = 1; copy < 40; ++copy)
    for (const Body& body : one.bodies) {
      Body next = body;
      next.name += "_" + std::to_string(copy);
      model.bodies.push_back(next);
    }
  for (int copy = 1; copy < 40; ++copy)
    for (Joint joint : one.joints) {
      const std::string tail = "_" + std::to_string(copy);
      joint.name += tail;
      if (joint.first.body != "ground") joint.first.body += tail;
      joint.second.body += tail;
      model.joints.push_back(joint);
    }
  const CheckReport report = check_model(model);
  EXPECT_EQ(report.mobility.method, "sparse factors");
  EXPECT_EQ(report.mobility.mobility, 40);
  EXPECT_EQ(report.mobility.redundant, 40);
  EXPECT_EQ(report.mobility.mobility_driven, 39);
  ASSERT_EQ(report.redundancies.size(), 40u);
  EXPECT_EQ(report.redundancies[7].members.size(), 9u);
  EXPECT_TRUE(report.passed());
}

}  // namespace
}  // namespace pintle
