// Distributions: quantiles invert their distribution functions; samples have the right moments.
#include "sweeps/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sweeps/philox.h"

namespace pintle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Variation variation(Distribution distribution, double mean, double deviation, double from = -kInfinity, double to = kInfinity, double mode = 0) {
  Variation v;
  v.distribution = distribution;
  v.mean = mean;
  v.deviation = deviation;
  v.from = from;
  v.to = to;
  v.mode = mode;
  return v;
}

struct Moments {
  double mean = 0, deviation = 0, least = kInfinity, most = -kInfinity;
};

Moments moments_of(const Variation& v) {
  constexpr int kN = 50000;
  Moments m;
  std::vector<double> x;
  for (int i = 0; i < kN; ++i) {
    x.push_back(quantile(v, uniform_number(3, 5, static_cast<std::uint64_t>(i))));
    m.mean += x.back() / kN;
    m.least = std::min(m.least, x.back());
    m.most = std::max(m.most, x.back());
  }
  for (const double y : x) m.deviation += (y - m.mean) * (y - m.mean) / (kN - 1);
  m.deviation = std::sqrt(m.deviation);
  return m;
}

// Within four standard errors of the mean, each deviation / sqrt(n).
void expect_moments(const Variation& v, double mean, double deviation) {
  const Moments m = moments_of(v);
  EXPECT_NEAR(m.mean, mean, 4 * deviation / std::sqrt(50000.0));
  EXPECT_NEAR(m.deviation, deviation, 0.03 * deviation);
}

TEST(Quantile, NormalUndoesTheErrorFunction) {
  for (const double p : {1e-300, 1e-30, 1e-9, 1e-3, 0.07, 0.3, 0.5}) {
    const double z = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::numbers::sqrt2) / p, 1, 1e-12) << p;
    if (p < 1e-10) continue;
    EXPECT_NEAR(normal_quantile(1 - p), -z, 1e-6 * std::abs(z));
  }
  EXPECT_EQ(normal_quantile(0.5), 0);
}

TEST(Quantile, SamplesHaveTheMoments) {
  expect_moments(variation(Distribution::kNormal, 5, 2), 5, 2);
  expect_moments(variation(Distribution::kLognormal, 5, 2), 5, 2);
  expect_moments(variation(Distribution::kUniform, 0, 0, 1, 3), 2, 2 / std::sqrt(12.0));
  expect_moments(variation(Distribution::kTriangular, 0, 0, 0, 3, 1), 4.0 / 3, std::sqrt((9.0 + 1 - 3) / 18));
}

// Half a normal distribution: mean sqrt(2/pi), variance 1 - 2/pi.
TEST(Quantile, CutOffDistributionsStayInside) {
  const Variation half = variation(Distribution::kNormal, 0, 1, 0);
  expect_moments(half, std::sqrt(2 / std::numbers::pi), std::sqrt(1 - 2 / std::numbers::pi));
  EXPECT_GE(moments_of(half).least, 0);
  const Moments upper = moments_of(variation(Distribution::kNormal, 0, 1, 5, 5.5)), bell = moments_of(variation(Distribution::kLognormal, 5, 2, 4, 6));
  EXPECT_GE(upper.least, 5);
  EXPECT_LE(upper.most, 5.5);
  EXPECT_GT(upper.mean, 5.1);
  EXPECT_LT(upper.mean, 5.2);  // decays as exp(-5 x)
  EXPECT_GE(bell.least, 4);
  EXPECT_LE(bell.most, 6);
}

TEST(Quantile, RisesWithTheShare) {
  for (const Variation& v : {variation(Distribution::kNormal, 1, 1, 0, 9), variation(Distribution::kLognormal, 1, 1), variation(Distribution::kUniform, 0, 0, -1, 1),
                             variation(Distribution::kTriangular, 0, 0, -1, 1, 1)}) {
    double before = -kInfinity;
    for (double u = 1e-6; u < 1; u += 1e-3) {
      EXPECT_GT(quantile(v, u), before);
      before = quantile(v, u);
    }
  }
}

}  // namespace
}  // namespace pintle
