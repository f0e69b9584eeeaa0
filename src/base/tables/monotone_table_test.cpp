#include "base/tables/monotone_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "base/random_for_tests.h"

namespace pintle {
namespace {

// Three-point slopes turn points on a parabola into that parabola: 1 + 2 x + 3 x^2, its slope and its integral.
TEST(MonotoneTable, IsTheParabolaThatItsPointsLieOn) {
  const auto f = [](double x) { return 1 + 2 * x + 3 * x * x; };
  const std::vector<double> x{0.5, 1, 1.2, 2, 3.5};
  std::vector<double> y;
  for (const double at : x) y.push_back(f(at));
  const MonotoneTable table(x, y);
  for (double at = 0.5; at <= 3.5; at += 0.01) {
    EXPECT_NEAR(table.value(at), f(at), 1e-13 * f(at));
    EXPECT_NEAR(table.slope(at), 2 + 6 * at, 1e-12);
    const double since = (at + at * at + at * at * at) - (0.5 + 0.25 + 0.125);
    EXPECT_NEAR(table.integral(at) - table.integral(0.5), since, 1e-13 * (1 + since));
  }
}

TEST(MonotoneTable, IsStraightBeyondItsEndsAndCountsItsIntegralFromZero) {
  const MonotoneTable table({1, 2}, {10, 14});
  EXPECT_DOUBLE_EQ(table.value(-1), 2);
  EXPECT_DOUBLE_EQ(table.value(1.5), 12);
  EXPECT_DOUBLE_EQ(table.value(4), 22);
  EXPECT_DOUBLE_EQ(table.slope(-7), 4);
  EXPECT_DOUBLE_EQ(table.integral(0), 0);
  EXPECT_DOUBLE_EQ(table.integral(4), 6 * 4 + 2 * 4 * 4);  // of 6 + 4 x
  EXPECT_DOUBLE_EQ(table.integral(-3), -6 * 3 + 2 * 3 * 3);
}

// Fritsch and Carlson's own data (their set RPN 14): a cubic spline overshoots, this curve does not.
TEST(MonotoneTable, NeverOvershoots) {
  const std::vector<double> x{7.99, 8.09, 8.19, 8.7, 9.2, 10, 12, 15, 20};
  const std::vector<double> y{0, 2.76429e-5, 4.37498e-2, 0.169183, 0.469428, 0.943740, 0.998636, 0.999919, 0.999994};
  const MonotoneTable table(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_DOUBLE_EQ(table.value(x[i]), y[i]);
  double last = table.value(7.9);
  for (double at = 7.9; at <= 21; at += 1e-3) {
    EXPECT_GE(table.slope(at), 0) << at;
    EXPECT_GE(table.value(at), last) << at;
    last = table.value(at);
  }
}

TEST(MonotoneTable, SlopesAndIntegralsAreThoseOfItsValues) {
  sample::Random random{1980};
  for (const auto symmetry : {MonotoneTable::Symmetry::kNone, MonotoneTable::Symmetry::kOdd}) {
    std::vector<double> x{0}, y{0};
    for (int i = 0; i < 7; ++i) {
      x.push_back(x.back() + random.uniform(0.05, 1));
      y.push_back(random.of_any_size(1e-2, 10));
    }
    const MonotoneTable table(x, y, symmetry);
    for (double at = -1; at < x.back() + 1; at += 0.0371) {
      const double slope = sample::slope_at_zero(1e-5, [&](double h) { return table.value(at + h); });
      const double rate = sample::slope_at_zero(1e-5, [&](double h) { return table.integral(at + h); });
      EXPECT_NEAR(slope, table.slope(at), 1e-6 * (1 + std::abs(table.slope(at)))) << at;
      EXPECT_NEAR(rate, table.value(at), 1e-8 * (1 + std::abs(table.value(at)))) << at;
    }
  }
}

TEST(MonotoneTable, AnOddTableIsTheSameBelowZero) {
  const MonotoneTable table({0, 1, 2, 3}, {0, 1, 4, 9}, MonotoneTable::Symmetry::kOdd);
  for (const double x : {0.0, 0.3, 1.0, 1.7, 5.0}) {
    EXPECT_EQ(table.value(-x), -table.value(x));
    EXPECT_EQ(table.slope(-x), table.slope(x));
    EXPECT_EQ(table.integral(-x), table.integral(x));
  }
  EXPECT_DOUBLE_EQ(table.slope(0), 1);
}

TEST(MonotoneTable, RefusesWhatIsNoFunction) {
  EXPECT_THROW(MonotoneTable({1}, {1}), std::invalid_argument);
  EXPECT_THROW(MonotoneTable({1, 2}, {1}), std::invalid_argument);
  EXPECT_THROW(MonotoneTable({1, 1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(MonotoneTable({0, 1}, {0.5, 2}, MonotoneTable::Symmetry::kOdd), std::invalid_argument);
}

}  // namespace
}  // namespace pintle
