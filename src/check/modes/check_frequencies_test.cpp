// Frequencies by hand: a bar on a pin, and the stability limit of Dormand-Prince.
#include "check/modes/check_frequencies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <utility>

#include "check/check_samples_for_tests.h"

namespace pintle {
namespace {

// Along the bar a force at the pin moves only the mass, 1/m = 1/kg; across the bar it also turns it, 1/m + r^2/I = 1 + 3 = 4
// /kg.
TEST(CheckFrequencies, BarOnAPin) {
  const CheckFrequencies f = check_model(checked::pendulum()).frequencies;
  const double k = 2e8, c = 3500, slow = std::sqrt(k), fast = std::sqrt(4 * k);
  ASSERT_EQ(f.components.size(), 2u);
  EXPECT_NEAR(f.components[0].effective_mass, 0.25, 1e-6);
  EXPECT_NEAR(f.components[0].frequency, fast, 1e-6 * fast);
  EXPECT_NEAR(f.components[0].damping_ratio, 4 * c / (2 * fast), 1e-6);
  EXPECT_NEAR(f.components[1].effective_mass, 1, 1e-6);
  ASSERT_TRUE(f.complete);
  ASSERT_EQ(f.modes.size(), 2u);
  EXPECT_NEAR(f.modes[0].frequency, slow, 1e-6 * slow);
  EXPECT_NEAR(f.modes[0].damping_ratio, c / (2 * slow), 1e-6);
  EXPECT_EQ(f.modes[0].component, "y");
  EXPECT_NEAR(f.modes[0].share, 1, 1e-6);
  EXPECT_NEAR(f.modes[1].frequency, fast, 1e-6 * fast);
  EXPECT_EQ(f.modes[1].component, "x");
  EXPECT_NEAR(f.explicit_step, dormand_prince_step(fast, 4 * c / (2 * fast)), 1e-6 * f.explicit_step);
}

// The same mechanism with each joint naming its bodies in the opposite order.
TEST(CheckFrequencies, DependOnNoOrderOfBodies) {
  Model model = checked::four_bar(1, 4, 4, 6, 60 * kDegree);
  const CheckFrequencies f = check_model(model).frequencies;
  for (Joint& joint : model.joints) std::swap(joint.first, joint.second);
  const CheckFrequencies turned = check_model(model).frequencies;
  ASSERT_EQ(f.modes.size(), turned.modes.size());
  for (std::size_t i = 0; i < f.modes.size(); ++i) EXPECT_NEAR(f.modes[i].frequency, turned.modes[i].frequency, 1e-9 * f.modes[i].frequency);
}

// A mass on rubber: mu^2 m + k (1 + sum r mu tau/(1 + mu tau)) = 0 at the reported frequency and damping ratio.
TEST(CheckFrequencies, RubberVibratesByItsBranches) {
  Model model = checked::pendulum();
  model.joints[0].type = "fixed";
  model.joints[0].law = {.word = "maxwell", .values = {{"stiffness", {4e5}}, {"angular_stiffness", {4e4}}, {"damping", {0}}, {"angular_damping", {0}}, {"branch_ratio", {0.5, 1}}, {"branch_time", {5e-3, 5e-2}}}};
  const CheckFrequencies f = check_model(model).frequencies;
  ASSERT_EQ(f.components.size(), 3u);
  for (const CheckComponent& c : f.components) {
    if (c.component == "angle") continue;
    const std::complex<double> mu = c.frequency * std::complex<double>(-c.damping_ratio, std::sqrt(1 - c.damping_ratio * c.damping_ratio));
    const auto branch = [&mu](double ratio, double time) { return ratio * mu * time / (1.0 + mu * time); };
    const std::complex<double> left = mu * mu * c.effective_mass + 4e5 * (1.0 + branch(0.5, 5e-3) + branch(1, 5e-2));
    EXPECT_LT(std::abs(left), 1e-5 * 4e5) << c.component;
    EXPECT_GT(c.damping_ratio, 0.01) << c.component;
  }
}

// Known to be 3.3066 on the negative real axis, and about 1 on the imaginary one.
TEST(CheckFrequencies, DormandPrinceStep) {
  EXPECT_NEAR(dormand_prince_step(100, 1), 3.3066 / 100, 5e-5);
  EXPECT_NEAR(dormand_prince_step(10, 0), 0.1, 0.01);
  EXPECT_LT(dormand_prince_step(100, 10), 3.4 / 1990);  // the fast root with strong damping
}

TEST(CheckFrequencies, AsManyModesAsConstraints) {
  const CheckFrequencies f = check_model(checked::four_bar(1, 4, 4, 6, 60 * kDegree)).frequencies;
  EXPECT_EQ(f.modes.size(), 8u);
  EXPECT_GT(f.modes.front().frequency, 10);
  EXPECT_LE(f.modes.front().frequency, f.modes.back().frequency);
}

}  // namespace
}  // namespace pintle
