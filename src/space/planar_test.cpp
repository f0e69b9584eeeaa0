#include "space/planar.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pintle {
namespace {

using S = Planar;

TEST(Planar, PerpTurnsByARightAngle) {
  EXPECT_EQ(S::perp({1, 0}), S::Point(0, 1));
  EXPECT_EQ(S::perp({0, 1}), S::Point(-1, 0));
  EXPECT_EQ(S::perp({3, -4}).dot(S::Point(3, -4)), 0);
}

TEST(Planar, CrossIsTheMomentAboutZ) {
  EXPECT_EQ(S::cross({2, 0}, {0, 3}), 6);
  EXPECT_EQ(S::cross({0, 3}, {2, 0}), -6);
  EXPECT_EQ(S::cross({2, 5}, {7, 1}), S::perp({2, 5}).dot(S::Point(7, 1)));
}

TEST(Planar, AMotionTurnsPointsOfItsBody) {
  const S::Motion m = S::Motion::of({1, 2, std::numbers::pi / 6}, {3, 4, 5});
  EXPECT_EQ(m.p, S::Point(1, 2));
  EXPECT_EQ(m.v, S::Point(3, 4));
  EXPECT_EQ(m.w, 5);
  const S::Point r = m.turned({2, 0});
  EXPECT_NEAR(r.x(), std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(r.y(), 1, 1e-15);
}

// The velocity of a body's point is v + w J r: the difference of its position.
TEST(Planar, PointVelocityIsTheDifferenceOfThePosition) {
  const S::Vec q(0.3, -0.2, 0.7), v(1.5, -2, 3);
  const S::Point r(0.4, 0.9);
  const double h = 1e-6;
  const S::Motion now = S::Motion::of(q, v), before = S::Motion::of(q - h * v, v), after = S::Motion::of(q + h * v, v);
  const S::Point difference = (after.p + after.turned(r) - before.p - before.turned(r)) / (2 * h);
  EXPECT_NEAR((difference - (now.v + now.w * S::perp(now.turned(r)))).norm(), 0, 1e-9);
}

TEST(Planar, AFrameKnowsItsDirection) {
  const S::Frame f = S::Frame::at({1, 2}, 0.5);
  EXPECT_DOUBLE_EQ(f.c, std::cos(0.5));
  EXPECT_DOUBLE_EQ(f.s, std::sin(0.5));
}

}  // namespace
}  // namespace pintle
