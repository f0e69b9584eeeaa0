// Growth of differences in time: exponentials are found with their rates; powers and offsets are not mistaken for them.
#include "run/errors/error_growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace pintle {
namespace {

DifferenceCurve curve_of(const std::function<double(double)>& e, double duration = 10, int rows = 1000) {
  DifferenceCurve curve;
  for (int i = 0; i <= rows; ++i) {
    curve.t.push_back(duration * i / rows);
    curve.e.push_back(i == 0 ? 0 : std::min(1.0, e(curve.t.back())));
  }
  return curve;
}

TEST(ErrorGrowth, AnExponentialIsFoundWithItsRateWithinItsError) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  int within = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const ErrorGrowth growth = fit_growth(curve_of([&](double t) { return 1e-6 * std::exp(2.5 * t + normal(random)); }));
    ASSERT_TRUE(growth.exponential);
    EXPECT_TRUE(growth.saturated);
    within += std::abs(growth.rate - 2.5) < 2 * growth.rate_error;
  }
  EXPECT_GE(within, 40);  // 95 % for normal errors
}

// As with pins that strike their bushes: each step multiplies the difference. By the line's standard error, a wrong rate would be taken for known twice as often.
TEST(ErrorGrowth, TheScatterIsThatOfStretchesWhoseErrorsGrowInSteps) {
  std::mt19937 random(2);
  std::exponential_distribution<double> waits(2.5), gains(1);
  int found = 0, within = 0, within_error = 0;
  for (int trial = 0; trial < 400; ++trial) {
    double next = waits(random), gain = 0;
    const ErrorGrowth growth = fit_growth(curve_of([&](double t) {
      for (; next < t; next += waits(random)) gain += gains(random);
      return 1e-7 * std::exp(gain);
    }));
    if (!(growth.rate > 0)) continue;
    ++found;
    within += std::abs(growth.rate - 2.5) < 2 * growth.rate_scatter;
    within_error += std::abs(growth.rate - 2.5) < 2 * growth.rate_error;
  }
  EXPECT_GT(found, 350);
  EXPECT_GT(within, 80 * found / 100);
  EXPECT_LT(within_error, 70 * found / 100);
}

// Increments that cancel count little: taken separately they would make the scatter a third of the rate.
TEST(ErrorGrowth, NoiseAboutALineAddsLittleToTheScatter) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const ErrorGrowth growth = fit_growth(curve_of([&](double t) { return 1e-7 * std::exp(2.5 * t + 0.5 * normal(random)); }));
    EXPECT_LT(growth.rate_scatter, 0.2 * growth.rate);
  }
}

TEST(ErrorGrowth, ExtrapolatesTheFittedLine) {
  const ErrorGrowth growth = fit_growth(curve_of([](double t) { return 1e-6 * std::exp(0.9 * t); }));
  ASSERT_TRUE(growth.exponential);
  EXPECT_FALSE(growth.saturated);
  EXPECT_NEAR(growth.rate, 0.9, 1e-3);
  EXPECT_NEAR(std::log(growth.extrapolated(20, growth.rate)), std::log(1e-6) + 18, 0.2);  // largest of each block, at its middle
}

TEST(ErrorGrowth, PowersOfTimeAreNotExponential) {
  for (const double power : {0.5, 1.0, 2.0, 3.0, 4.0})
    for (const double level : {1e-7, 1e-3, 1.0})
      for (const double ripple : {0.0, 0.9}) {
        const auto e = [&](double t) { return level * std::pow(t / 5, power) * (1 + ripple * std::sin(40 * t)) + 1e-12; };
        EXPECT_FALSE(fit_growth(curve_of(e)).exponential) << power << " " << level << " " << ripple;
        EXPECT_FALSE(fit_growth_to_largest(curve_of(e)).exponential) << power << " " << level << " " << ripple;
      }
}

// For example after a shock in the middle, from which phases drift apart.
TEST(ErrorGrowth, APowerOfTimeThatBeginsLateIsNotExponential) {
  for (const double power : {1.0, 2.0})
    EXPECT_FALSE(fit_growth(curve_of([&](double t) { return t < 4 ? 1e-9 : 1e-2 * std::pow((t - 4) / 6, power) + 1e-9; })).exponential) << power;
}

TEST(ErrorGrowth, ADifferenceThatIsLargeFromTheStartOrDecaysIsNotGrowth) {
  EXPECT_FALSE(fit_growth(curve_of([](double t) { return 0.5 * std::abs(std::sin(300 * t)); })).exponential);
  EXPECT_FALSE(fit_growth(curve_of([](double t) { return 0.02 * std::exp(-t); })).exponential);
  EXPECT_FALSE(fit_growth(curve_of([](double) { return 0.0; })).exponential);
}

TEST(ErrorGrowth, ASmallerToleranceShiftsAnExponentialAndStretchesAPower) {
  const auto exponential = [](double level) { return fit_growth(curve_of([level](double t) { return level * std::exp(2 * t); })); };
  EXPECT_TRUE(same_growth(exponential(1e-5), exponential(1e-6)));
  ErrorGrowth first = exponential(1e-5), slower = first;
  slower.rate = first.rate / std::sqrt(10);  // as a fit to the square of time would have it with a tenth of the tolerance
  EXPECT_FALSE(same_growth(first, slower));
  EXPECT_FALSE(same_growth(exponential(1e-6), exponential(1e-5)));  // it saturates earlier, and shows nothing about smaller tolerances
}

TEST(ErrorGrowth, PlacesThatClearancesKeepTogetherSaturateAtTheirLargestDifference) {
  const DifferenceCurve kept = curve_of([](double t) { return std::min(1e-3, 1e-9 * std::exp(2 * t)); });
  EXPECT_FALSE(fit_growth(kept).saturated);
  const ErrorGrowth growth = fit_growth_to_largest(kept);
  EXPECT_TRUE(growth.exponential);
  EXPECT_NEAR(growth.rate, 2, 0.02);
  EXPECT_NEAR(growth.until, 0.5 * std::log(1e-4 / 1e-9), 0.5);
  EXPECT_TRUE(growth.saturated);
  EXPECT_FALSE(fit_growth_to_largest(curve_of([](double t) { return 1e-12 * std::exp(2 * t); })).saturated);  // still growing at the end
}

}  // namespace
}  // namespace pintle
