#include "base/bends.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pintle {
namespace {

TEST(Bends, TheSecondOneEndsTheWay) {
  const Bends bends{{1, 2, 5}};
  EXPECT_EQ(bends.share_to_second_bend(0, 4), 0.5);
  EXPECT_EQ(bends.share_to_second_bend(0, 1.9), 1);
  EXPECT_EQ(bends.share_to_second_bend(0, 2.01), 1);  // a little beyond the second
  EXPECT_EQ(bends.share_to_second_bend(0, 5.1), 2 / 5.1);
  EXPECT_EQ((Bends{{4.7, 4.8, 4.9}}.share_to_second_bend(0, 5)), 4.8 / 5);  // all of them at the end of a long interval
  EXPECT_EQ(bends.share_to_second_bend(1, 9), 0.5);  // a bend at the start does not count
  EXPECT_EQ(bends.share_to_second_bend(2, 9), 1);
  EXPECT_EQ(bends.share_to_second_bend(6, 0), 4.0 / 6);
  EXPECT_EQ(bends.share_to_second_bend(5, 0), 4.0 / 5);
  EXPECT_EQ(bends.share_to_second_bend(1, 0), 1);
  EXPECT_EQ(bends.share_to_second_bend(3, 3), 1);
  EXPECT_EQ(Bends{}.share_to_second_bend(0, 9), 1);
}

TEST(Bends, GoOnWithTheirPeriod) {
  const Bends bends{{-1, 0, 1}, 10};
  EXPECT_EQ(bends.share_to_second_bend(2, 22), 8.0 / 20);     // 9, 10
  EXPECT_EQ(bends.share_to_second_bend(30, 50), 9.0 / 20);    // 31, 39
  EXPECT_EQ(bends.share_to_second_bend(-2, -22), 8.0 / 20);   // -9, -10
  EXPECT_EQ(bends.share_to_second_bend(-30, -50), 9.0 / 20);  // -31, -39
  EXPECT_EQ(bends.share_to_second_bend(1, 5), 1);
}

// Wherever rounding places the bends of a period.
TEST(Bends, AlwaysLeaveAWay) {
  const Bends bends{{-0.04, 0, 0.04}, std::numbers::pi / 4};
  for (int turn = -50; turn <= 50; ++turn)
    for (const double place : bends.places)
      for (const double last_bits : {-1e-15, 0.0, 1e-15}) {
        const double from = (place + turn * bends.period) * (1 + last_bits);
        for (const double way : {-3.0, 3.0}) {
          const double share = bends.share_to_second_bend(from, from + way);
          EXPECT_GT(std::abs(share * way), 0.0399) << from;
          EXPECT_LT(std::abs(share * way), 0.8) << from;
        }
      }
}

TEST(Bends, OfABumpAreOnEitherSideOfIt) {
  const auto curvature = [](double x) { return std::exp(-x * x) * (4 * x * x - 2); };
  const Bends bends = find_bends(curvature, -5, 5);
  ASSERT_EQ(bends.places.size(), 4U);  // straight, concave, convex, concave, straight
  EXPECT_NEAR(bends.places[1], -std::numbers::sqrt2 / 2, 10.0 / 720);
  EXPECT_NEAR(bends.places[2], std::numbers::sqrt2 / 2, 10.0 / 720);
  EXPECT_TRUE(find_bends([](double) { return 0.0; }, 0, 1).empty());
}

TEST(Bends, OfAGraphAreThoseOfItsSecondDifferences) {
  SampledGraph samples(2000);
  const auto bends_of = [&samples](const auto& f, double low, double high, int parts) {
    std::vector<double> places;
    samples.take(f, low, high, parts);
    samples.for_each_bend([&](double part) { places.push_back(low + part * (high - low) / parts); });
    return places;
  };
  const auto pulse = [](double t) { return 200 * std::exp(-std::pow((t - 3) / 0.005, 2)); };
  const std::vector<double> places = bends_of(pulse, 0, 6, 2000);
  ASSERT_GE(places.size(), 2U);
  for (const double place : places) EXPECT_NEAR(place, 3, 0.02);
  EXPECT_TRUE(bends_of([](double t) { return 1e6 + 7 * t; }, 0, 6, 2000).empty());
  EXPECT_TRUE(bends_of([](double t) { return 1e7 * (t - 0.3); }, 0.3, 0.3 + 1e-9, 2000).empty());  // rounding causes no bends
  EXPECT_TRUE(bends_of([](double t) { return 100 * (std::sin(t) * std::sin(t) + std::cos(t) * std::cos(t)); }, 0, 6, 2000).empty());
  const std::vector<double> of_sine = bends_of([](double t) { return std::sin(t); }, 0.5, 3.5 * std::numbers::pi, 200);
  ASSERT_EQ(of_sine.size(), 3U);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(of_sine[i], (i + 1) * std::numbers::pi, 0.06);
}

}  // namespace
}  // namespace pintle
