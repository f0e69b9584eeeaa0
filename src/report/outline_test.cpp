#include "report/outline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pintle {
namespace {

TEST(Outline, HullOfASquareLeavesOutWhatIsInside) {
  const std::vector<Vec2> hull = convex_hull({{0, 0}, {1, 1}, {0.5, 0.5}, {1, 0}, {0, 1}, {0.2, 0.7}, {0, 0}}, 0.01);
  ASSERT_EQ(hull.size(), 4u);
  double area = 0;
  for (std::size_t i = 0; i < 4; ++i) area += 0.5 * cross(hull[i], hull[(i + 1) % 4]);
  EXPECT_DOUBLE_EQ(area, 1);  // counter-clockwise
}

TEST(Outline, PointsInARowLeaveTheirEnds) {
  const std::vector<Vec2> hull = convex_hull({{0, 0}, {2, 2.001}, {1, 1}, {4, 4}, {3, 3}}, 0.01);
  ASSERT_EQ(hull.size(), 2u);
  EXPECT_DOUBLE_EQ(length(hull[1] - hull[0]), length(Vec2{4, 4}));
}

TEST(Outline, NearestPointStaysOnTheSegment) {
  EXPECT_EQ(nearest_on({0, 0}, {2, 0}, {1, 5}), (Vec2{1, 0}));
  EXPECT_EQ(nearest_on({0, 0}, {2, 0}, {-3, 1}), (Vec2{0, 0}));
  EXPECT_EQ(nearest_on({1, 1}, {1, 1}, {4, 4}), (Vec2{1, 1}));
}

TEST(Outline, RectangleTurnsWithItsDirection) {
  const std::vector<Vec2> corners = rectangle({1, 2}, direction(1.1), {3, 0.5});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(length(corners[i] - Vec2{1, 2}), std::hypot(3, 0.5), 1e-14);
    EXPECT_NEAR(length(corners[(i + 1) % 4] - corners[i]), i % 2 ? 1 : 6, 1e-14);
  }
}

}  // namespace
}  // namespace pintle
