// Belts and ropes on drums: the common battery, then cases of winding that can be followed by hand.
#include "joints/belt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "joints/catalog.h"
#include "joints/joint_checks_for_tests.h"

namespace pintle {
namespace {

using Vec = Planar::Vec;
using sample::Couple;

double gap(const Belt& belt, const Couple& c) { return belt(c.pose().z).gap; }
Couple at_rest() {
  Couple c;
  c.qA = c.qB = c.vA = c.vB = Vec::Zero();
  return c;
}

TEST(Belt, PassesTheBatteryOfJointDisplacements) {
  sample::Random random(11);
  for (int i = 0; i < 200; ++i) {
    const Couple c = sample::random_couple(random);
    Belt belt{(random.coin() ? 1 : -1) * random.uniform(0.1, 0.15), random.coin() ? 0 : random.uniform(-0.05, 0.05), 0};
    belt.length = belt(c.pose().z).gap + random.uniform(-0.01, 0.01);  // the jump by a full turn is at least 0.03 m away
    sample::expect_all(function_of(belt), c, random);
    if (testing::Test::HasFailure()) return;
  }
}

// A string that unwinds from a disc traces its involute: from (cos p, sin p), p radii along the tangent.
TEST(Belt, UnwindsAlongAnInvolute) {
  for (const double side : {1.0, -1.0}) {
    Belt belt{0.3 * side, 0, 0};
    Couple c = at_rest();
    bool first = true;
    for (double p = 0.5; p < 30; p += 0.1) {  // almost five turns
      c.qB = 0.3 * Vec(std::cos(p) + p * std::sin(p), side * (std::sin(p) - p * std::cos(p)), 0);
      if (first) belt.length += gap(belt, c);
      first = false;
      EXPECT_NEAR(gap(belt, c), 0, 1e-13) << side << ' ' << p;
      EXPECT_NEAR(belt.run(c.pose().z), 0.3 * p, 1e-13);
    }
  }
}

TEST(Belt, ADrumTakesInItsRadiusTimesItsAngle) {
  Belt belt{0.2, 0, 0};  // the run hangs on the drum's right, which is on the left looking down the run
  Couple c = at_rest();
  c.qB = {0.2, -40, 0};
  belt.length += gap(belt, c);
  EXPECT_EQ(gap(belt, c), 0);
  EXPECT_NEAR(belt.run(c.pose().z), 40, 1e-13);
  for (const double turned : {0.3, 4.0, 50.0, 123.0}) {
    c.qA = {0, 0, turned};
    c.qB = {0.2, -40 + 0.2 * turned, -1.7};
    EXPECT_NEAR(gap(belt, c), 0, 1e-12) << turned;
    c.qB[1] += 0.6;  // slack by less than the 0.63 m of half a turn
    EXPECT_NEAR(gap(belt, c), -0.6, 1e-12) << turned;
    c.qB[1] -= 1.2;
    EXPECT_NEAR(gap(belt, c), 0.6, 1e-12) << turned;
  }
}

// An open belt turns both pulleys in the same direction, a crossed one in opposite directions; in the ratio of their radii.
TEST(Belt, TurnsPulleysByTheirRadii) {
  for (const double side : {1.0, -1.0})
    for (const double crossed : {1.0, -1.0}) {
      Belt belt{0.1 * side, 0.25 * side * crossed, 0};
      Couple c = at_rest();
      c.qB = {1, 0.3, 0.2};
      belt.length += gap(belt, c);
      for (const double turned : {0.1, -2.0, 40.0, -300.0}) {
        c.qA[2] = turned;
        c.qB[2] = 0.2 + crossed * turned * 0.1 / 0.25;
        EXPECT_NEAR(gap(belt, c), 0, 1e-11) << side << crossed << turned;
      }
      EXPECT_NEAR(belt.run(c.pose().z), std::sqrt(1.09 - std::pow(crossed > 0 ? 0.15 : 0.35, 2)), 1e-12);
    }
}

// The line of the force is tangent to both discs: its moment about their centres is the tension times the radius.
TEST(Belt, PullsAlongTheTangentOfBothDiscs) {
  sample::Random random(12);
  for (int i = 0; i < 50; ++i) {
    const Couple c = sample::random_couple(random);
    const RelativePose pose = c.pose();
    const Belt belt{random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), 0};
    const Vec f = to_pose_force(JointDisplacement(function_of(belt)), pose, Vec(-7, 0, 0));  // 7 N of tension, on the second body
    EXPECT_NEAR(std::hypot(f[0], f[1]), 7, 1e-13);
    EXPECT_NEAR(f[2], 7 * belt.radius_second, 1e-13);
    EXPECT_NEAR(-f[2] - (pose.z[0] * f[1] - pose.z[1] * f[0]), -7 * belt.radius_first, 1e-13);  // on the first
  }
}

TEST(Belt, IsFiniteWhereItHasNoWay) {
  const Belt belt{0.2, 0, 0};
  for (const Vec& z : {Vec(0, 0, 0), Vec(0.1, 0.1, 1), Vec(0.2, 0, 0)}) {
    const GapFunction g = belt(z);
    EXPECT_TRUE(std::isfinite(g.gap) && g.gradient.allFinite() && g.hessian.allFinite());
    EXPECT_EQ(belt.run(z), 0);
  }
}

TEST(Belt, TakesItsSidesFromWords) {
  const JointTypeInfo& type = *find_joint_type("belt");
  const auto made = [&type](const Geometry& g) { return *belt_of(type.make(g)); };
  const Belt open = made({{"first_radius", 0.1}, {"second_radius", 0.3}, {"first_side", 1}});
  EXPECT_EQ(open.radius_first, -0.1);
  EXPECT_EQ(open.radius_second, -0.3);
  const Belt crossed = made({{"first_radius", 0.1}, {"second_radius", 0.3}, {"second_side", 1}});
  EXPECT_EQ(crossed.radius_first, 0.1);
  EXPECT_EQ(crossed.radius_second, -0.3);
  EXPECT_FALSE(belt_of(Distance{1}));
  EXPECT_EQ(type.fault({}).key, "first_radius");
  EXPECT_EQ(type.fault({{"first_radius", 0.1}, {"second_side", 0}}).key, "second_side");
  EXPECT_EQ(type.fault({{"second_radius", 0.1}, {"first_side", 0}}).key, "first_side");
  EXPECT_EQ(type.fault({{"second_radius", 0.1}}).key, "");
}

}  // namespace
}  // namespace pintle
