// Small motions by hand: a bar that hangs or stands on its pin, or floats there; one on rubber; and one that does not rest.
#include "check/modes/check_small_motions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "check/check_samples_for_tests.h"

namespace pintle {
namespace {

// m g r against I + m r^2 about the pin, to what the pin yields.
const double kPendulum = std::sqrt(9.81 * 0.5 * 3);

CheckSmallMotions bar_on_a_pin(Vec2 gravity) {
  Model model = checked::pendulum();
  model.gravity = gravity;
  return check_model(model).small_motions;
}

TEST(CheckSmallMotions, BarThatHangs) {
  const CheckSmallMotions s = bar_on_a_pin({0, 9.81});
  ASSERT_TRUE(s.known) << s.remark;
  ASSERT_EQ(s.modes.size(), 3u);
  EXPECT_NEAR(s.modes[0].frequency, kPendulum, 1e-6 * kPendulum);
  EXPECT_NEAR(s.modes[0].damping_ratio, 0, 1e-6);
  EXPECT_EQ(s.modes[0].body, "rod");
  EXPECT_EQ(s.modes[0].direction, "x");
  EXPECT_NEAR(s.modes[0].share, 0.75, 1e-6);  // m r^2 of I + m r^2
  EXPECT_NEAR(s.modes[1].frequency, std::sqrt(2e8), 1);
  EXPECT_NEAR(s.modes[1].damping_ratio, 3500 / (2 * std::sqrt(2e8)), 1e-4);
  EXPECT_NEAR(s.modes[2].frequency, std::sqrt(8e8), 1);
  EXPECT_EQ(s.n_free, 0);
}

TEST(CheckSmallMotions, BarThatStandsFallsOver) {
  const CheckSmallMotions s = bar_on_a_pin({0, -9.81});
  ASSERT_TRUE(s.known) << s.remark;
  ASSERT_EQ(s.modes.size(), 4u);
  for (const int i : {0, 1}) EXPECT_EQ(s.modes[i].imaginary, 0);
  EXPECT_NEAR(std::max(s.modes[0].real, s.modes[1].real), kPendulum, 1e-5 * kPendulum);
  EXPECT_NEAR(std::min(s.modes[0].real, s.modes[1].real), -kPendulum, 1e-5 * kPendulum);
}

TEST(CheckSmallMotions, WithoutGravityTheBarIsFree) {
  const CheckSmallMotions s = bar_on_a_pin({0, 0});
  ASSERT_TRUE(s.known) << s.remark;
  EXPECT_EQ(s.modes.size(), 2u);
  EXPECT_EQ(s.n_free, 1);
}

// m mu^2 + k (1 + sum r mu tau/(1 + mu tau)) = 0 along the bar, which assembly has laid along x: a vibration, and what the branches creep.
TEST(CheckSmallMotions, RubberIsSolvedWithItsBranches) {
  Model model = checked::pendulum();
  model.gravity = {0, 0};
  model.joints[0].type = "fixed";
  model.joints[0].law = {.word = "maxwell", .values = {{"stiffness", {4e5}}, {"angular_stiffness", {4e4}}, {"damping", {0}}, {"angular_damping", {0}}, {"branch_ratio", {0.5, 1}}, {"branch_time", {5e-3, 5e-2}}}};
  const CheckSmallMotions s = check_model(model).small_motions;
  ASSERT_TRUE(s.known) << s.remark;
  int along = 0;
  for (const CheckSmallMotion& m : s.modes) {
    if (m.direction != "x" || m.share < 0.999) continue;
    ++along;
    const std::complex<double> mu(m.real, m.imaginary);
    const auto branch = [&mu](double ratio, double time) { return ratio * mu * time / (1.0 + mu * time); };
    EXPECT_LT(std::abs(mu * mu + 4e5 * (1.0 + branch(0.5, 5e-3) + branch(1, 5e-2))), 1e-6 * 4e5);
  }
  EXPECT_EQ(along, 3);  // a pair, and one for each branch
}

TEST(CheckSmallMotions, WhatDoesNotRestIsNotExamined) {
  const CheckSmallMotions falling = check_model(checked::pendulum()).small_motions;
  EXPECT_FALSE(falling.known);
  EXPECT_NE(falling.remark.find("settled"), std::string::npos) << falling.remark;
  EXPECT_TRUE(falling.modes.empty());
}

}  // namespace
}  // namespace pintle
