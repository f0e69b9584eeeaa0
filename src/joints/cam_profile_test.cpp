// Profiles of cams by hand: eccentric circles, which have closed forms, and profiles on which no follower can run.
#include "joints/cam_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "base/expression/expression_parser.h"
#include "base/random_for_tests.h"
#include "base/units.h"

namespace pintle {
namespace {

Expression lift(const std::string& text) {
  ParseScope scope;
  scope.variables = {{"angle", kAngle}};
  return std::get<ParsedExpression>(parse_expression(text, scope)).expression;
}

// A circle of 40 mm, 10 mm off the axis, with a roller of 12 mm.
CamProfile eccentric() { return CamProfile({lift("0.01*cos(angle) + sqrt(0.052^2 - (0.01*sin(angle))^2) - 0.052"), 0.04, 0.012, false}); }
CamProfile eccentric_and_flat() { return CamProfile({lift("0.01*cos(angle)"), 0.04, 0, true}); }

TEST(CamProfile, AnEccentricCircleHasItsSurface) {
  const CamProfile roller = eccentric(), flat = eccentric_and_flat();
  for (double angle = -7; angle < 7; angle += 0.1)
    for (const CamProfile* cam : {&roller, &flat}) {
      EXPECT_NEAR((cam->surface(angle) - Planar::Point(0.01, 0)).norm(), 0.04, 1e-14) << angle;
      EXPECT_NEAR(cam->surface_curvature(angle), 0.04, 1e-12) << angle;
      EXPECT_EQ(cam->fault(), "");
    }
}

// Wherever the roller is, near the cam or far from it, its gap follows from the distance of the centres.
TEST(CamGap, IsTheDistanceFromAnEccentricCircle) {
  const CamProfile profile = eccentric();
  const CamGap gap{&profile};
  sample::Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double distance = std::abs(random.of_any_size(2e-2, 10)), direction = random.uniform(-4, 4);
    const Planar::Vec z(0.01 + distance * std::cos(direction), distance * std::sin(direction), random.uniform(-3, 3));
    const GapFunction g = gap.gap_and_slip(z)[0];
    EXPECT_NEAR(g.gap, distance - 0.052, 1e-13 * (1 + distance));
    EXPECT_NEAR(g.gradient[0], std::cos(direction), 1e-10);
    EXPECT_NEAR(g.gradient[1], std::sin(direction), 1e-10);
    EXPECT_NEAR(g.hessian.trace(), 1 / distance, 1e-8 / distance);
  }
}

// A cam with four lobes, concave between them, compared with the nearest of very many points.
TEST(CamGap, IsTheDistanceFromTheNearestPoint) {
  const CamProfile profile({lift("0.004*(1 - cos(4*angle))"), 0.05, 0.01, false});
  ASSERT_EQ(profile.fault(), "");
  const CamGap gap{&profile};
  sample::Random random(4);
  for (int i = 0; i < 80; ++i) {
    const double angle = random.uniform(-4, 4), out = i < 40 ? random.uniform(-0.005, 0.01) : random.uniform(0.01, 0.1), r = profile.radius(angle)[0] + out;
    double least = 1;
    for (int k = 0; k < 50000; ++k) {
      const double at = angle - 0.8 + 1.6 * k / 50000, p = profile.radius(at)[0];
      least = std::min(least, std::hypot(r * std::cos(angle) - p * std::cos(at), r * std::sin(angle) - p * std::sin(at)));
    }
    EXPECT_NEAR(std::abs(gap.gap_and_slip({r * std::cos(angle), r * std::sin(angle), 0})[0].gap), least, 1e-8) << angle << " " << out;
  }
}

TEST(CamGap, OfAFlatFaceOnAnEccentricCircle) {
  const CamProfile profile = eccentric_and_flat();
  const CamGap gap{&profile};
  for (double turn = -7; turn < 7; turn += 0.37) {
    const Planar::Point m(-std::sin(turn), std::cos(turn)), along(std::cos(turn), std::sin(turn));
    const Planar::Point on_face = Planar::Point(0.01, 0) + 0.043 * m + 0.2 * along;  // 3 mm off the circle
    EXPECT_NEAR(gap.gap_and_slip({on_face[0], on_face[1], turn})[0].gap, 0.003, 1e-15) << turn;
  }
}

TEST(CamProfile, TellsWhereTheFollowerIs) {
  const CamProfile profile = eccentric();
  for (double direction = -3; direction < 3; direction += 0.2) {
    const Planar::Vec z(0.01 + 0.052 * std::cos(direction), 0.052 * std::sin(direction), 0.3);
    EXPECT_NEAR(profile.place(z).angle, std::atan2(z[1], z[0]), 1e-12);
    EXPECT_NEAR(profile.place(z).pressure_angle, std::remainder(direction - 0.3 - kTurn / 4, kTurn), 1e-12);
  }
}

TEST(CamProfile, SaysWhyNoFollowerCanRunOnIt) {
  const auto fault = [](const std::string& text, double base, double roller, bool flat) { return CamProfile({lift(text), base, roller, flat}).fault(); };
  EXPECT_NE(fault("0.01*cos(angle)", 0.005, 0, false).find("the radius at"), std::string::npos);
  EXPECT_NE(fault("0.001*angle", 0.04, 0, false).find("does not close: after a turn the lift is 0.006283 m higher"), std::string::npos);
  EXPECT_NE(fault("0.01*sin(angle/2)", 0.04, 0, false).find("a corner where it closes"), std::string::npos);
  EXPECT_NE(fault("0.003*cos(6*angle)", 0.03, 0.02, false).find("undercut"), std::string::npos);
  EXPECT_EQ(fault("0.003*cos(6*angle)", 0.03, 0.002, false), "");
  EXPECT_NE(fault("0.01*cos(3*angle)", 0.04, 0, true).find("hollow"), std::string::npos);
  EXPECT_NE(fault("0.01*abs(sin(angle/2) - 0.5)", 0.04, 0, false).find("a corner at 60 deg"), std::string::npos);
  EXPECT_NE(fault("0.01*sqrt(angle)", 0.04, 0, false).find("not finite at 0 deg"), std::string::npos);
  EXPECT_EQ(fault("0", 0.04, 0.01, false), "");
}

}  // namespace
}  // namespace pintle
