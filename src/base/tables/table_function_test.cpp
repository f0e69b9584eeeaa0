#include "base/tables/table_function.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/constants.h"
#include "base/random_for_tests.h"

namespace pintle {
namespace {

using enum TableInterpolation;
using enum TableOutside;

constexpr TableInterpolation kAll[] = {kLinear, kMonotone, kSpline};

// A wave with period 2 pi, known at n places with different spacings, starting at x = -1.
double exact_wave(double x) { return std::sin(x) + 0.3 * std::cos(2 * x); }
std::vector<double> places(int n, bool closed) {
  std::vector<double> x;
  for (int i = 0; i < n + (closed ? 1 : 0); ++i) x.push_back(-1 + kTurn * (static_cast<double>(i) / n + 0.05 * std::sin(kTurn * i / n)));
  return x;
}
TableFunction wave(int n, TableInterpolation interpolation, bool closed) {
  const std::vector<double> x = places(n, closed);
  std::vector<double> y;
  for (const double at : x) y.push_back(exact_wave(at));
  return {x, y, interpolation, kHold, kTurn};
}

double most_off(int n, TableInterpolation interpolation) {
  const TableFunction f = wave(n, interpolation, true);
  double most = 0;
  for (double x = -1; x < 6; x += 0.003) most = std::max(most, std::abs(f.value(x) - exact_wave(x)));
  return most;
}

TEST(TableFunction, GoesThroughItsPoints) {
  const std::vector<double> x{-2, 0, 1, 5}, y{3, -1, 4, 4};
  for (const auto interpolation : kAll)
    for (const auto outside : {kHold, kExtend}) {
      const TableFunction f(x, y, interpolation, outside);
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_DOUBLE_EQ(f.value(x[i]), y[i]);
    }
}

TEST(TableFunction, GoesStraightBetweenPoints) {
  const TableFunction f({0, 1, 3}, {10, 20, 16}, kLinear);
  EXPECT_DOUBLE_EQ(f.value(0.25), 12.5);
  EXPECT_DOUBLE_EQ(f.value(2), 18);
  EXPECT_DOUBLE_EQ(f.at(2).first, -2);
  EXPECT_DOUBLE_EQ(f.at(2).second, 0);
}

// Fourth-order differences, exact for cubics, inside the pieces.
void expect_derivatives(const TableFunction& f, const std::vector<double>& points, double period) {
  sample::Random random(7);
  const double h = 1e-3;
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const double x = random.uniform(-15, 15);
    const auto is_near = [&](double point) { return std::abs(period > 0 ? std::remainder(x - point, period) : x - point) < 3 * h; };
    if (std::any_of(points.begin(), points.end(), is_near)) continue;
    const auto slope = [&](double d) { return (f.value(x + d) - f.value(x - d)) / (2 * d); };
    const auto bend = [&](double d) { return (f.at(x + d).first - f.at(x - d).first) / (2 * d); };
    EXPECT_EQ(f.at(x).value, f.value(x));
    EXPECT_NEAR(f.at(x).first, (4 * slope(h) - slope(2 * h)) / 3, 1e-9) << x;
    EXPECT_NEAR(f.at(x).second, (4 * bend(h) - bend(2 * h)) / 3, 1e-9) << x;
    ++compared;
  }
  EXPECT_GT(compared, 250);
}

TEST(TableFunction, DerivativesAreThoseOfItsValues) {
  const std::vector<double> x{-1, 0.5, 2, 2.7}, y{1, 3, -2, 0.5};
  for (const auto interpolation : kAll) {
    expect_derivatives(wave(9, interpolation, false), places(9, false), kTurn);
    for (const auto outside : {kHold, kExtend}) expect_derivatives({x, y, interpolation, outside}, x, 0);
  }
}

TEST(TableFunction, RepeatsItself) {
  for (const auto interpolation : kAll)
    for (const bool closed : {true, false}) {
      const TableFunction f = wave(8, interpolation, closed);
      for (double x = -0.95; x < 5.2; x += 0.1)
        for (const int turns : {-3, 1, 1000}) {
          EXPECT_NEAR(f.value(x + turns * kTurn), f.value(x), 1e-11) << x;
          EXPECT_NEAR(f.at(x + turns * kTurn).first, f.at(x).first, 1e-9) << x;
        }
    }
}

// A periodic table of three points and one that lists the same points twice are the same function.
TEST(TableFunction, DoesNotDependOnWhereThePeriodBegins) {
  for (const auto interpolation : kAll) {
    const TableFunction one({0, 1, 2.5}, {1, 4, 2}, interpolation, kHold, 4), later({1, 2.5, 4, 5}, {4, 2, 1, 4}, interpolation, kHold, 4),
        twice({0, 1, 2.5, 4, 5, 6.5}, {1, 4, 2, 1, 4, 2}, interpolation, kHold, 8);
    for (double x = -3; x < 9; x += 0.01) {
      EXPECT_NEAR(one.value(x), later.value(x), 1e-13) << x;
      EXPECT_NEAR(one.value(x), twice.value(x), 1e-13) << x;
    }
  }
}

// When the spacings are halved: order two for straight lines, order four for splines.
TEST(TableFunction, ConvergesToASmoothFunction) {
  EXPECT_NEAR(std::log2(most_off(40, kLinear) / most_off(80, kLinear)), 2, 0.1);
  EXPECT_NEAR(std::log2(most_off(40, kSpline) / most_off(80, kSpline)), 4, 0.2);
  EXPECT_LT(most_off(80, kMonotone), most_off(80, kLinear));
  EXPECT_LT(most_off(80, kSpline), 2e-6);
}

TEST(TableFunction, SplinesHaveAContinuousSecondDerivative) {
  const std::vector<double> x{0, 0.4, 1, 1.1, 2};
  const TableFunction free(x, {0, 3, 1, 1, -2}, kSpline, kExtend), closed(x, {0, 3, 1, 1, 0}, kSpline, kHold, 2);
  for (const TableFunction* f : {&free, &closed})
    for (const double at : x) EXPECT_NEAR(f->at(at - 1e-9).second, f->at(at + 1e-9).second, 1e-4) << at;
  EXPECT_NEAR(free.at(1e-9).second, 0, 1e-4);
}

TEST(TableFunction, IsHeldOrGoesOnBeyondItsEnds) {
  const TableFunction held({1, 2, 4}, {5, 7, 1}, kLinear, kHold), on({1, 2, 4}, {5, 7, 1}, kLinear, kExtend);
  EXPECT_DOUBLE_EQ(held.value(0), 5);
  EXPECT_DOUBLE_EQ(held.value(9), 1);
  EXPECT_DOUBLE_EQ(held.at(9).first, 0);
  EXPECT_DOUBLE_EQ(on.value(0), 3);
  EXPECT_DOUBLE_EQ(on.value(5), -2);
  EXPECT_DOUBLE_EQ(on.at(5).first, -3);
}

// At each kink, and nowhere else, the switching function changes sign, and it has no extremum there.
void expect_sign_changes(const TableFunction& f, const std::vector<double>& kinks, double from, double to) {
  ASSERT_TRUE(f.has_kinks());
  std::vector<double> found;
  const double step = 1e-3;
  for (double x = from; x < to; x += step)
    if ((f.switching(x) > 0) != (f.switching(x + step) > 0)) found.push_back(x + step / 2);
  ASSERT_EQ(found.size(), kinks.size());
  for (std::size_t i = 0; i < kinks.size(); ++i) {
    EXPECT_NEAR(found[i], kinks[i], step);
    const double h = 1e-6, before = f.switching(kinks[i] - h), behind = f.switching(kinks[i] + h);
    EXPECT_NEAR(std::abs(before), h, 1e-9);
    EXPECT_NEAR(before, -behind, 1e-9);
  }
}

TEST(TableFunction, SwitchesAtItsKinks) {
  const std::vector<double> x{0, 1, 1.5, 3}, y{0, 2, 3, 1};
  expect_sign_changes({x, y, kLinear, kHold}, {0, 1.5, 3}, -0.9995, 5);  // at 1 it continues straight
  expect_sign_changes({x, y, kLinear, kExtend}, {1.5}, -0.9995, 5);
  expect_sign_changes({x, y, kMonotone, kHold}, {0, 1, 1.5, 3}, -0.9995, 5);
  expect_sign_changes({x, y, kMonotone, kExtend}, {1, 1.5}, -0.9995, 5);
  expect_sign_changes({{0, 1, 2, 3, 4}, {0, 1, 2.02, 3.02, 0}, kMonotone, kExtend}, {2, 3}, -0.9995, 5);  // the curvature jumps at all inner points, at 1 only by little
  EXPECT_FALSE(TableFunction({0, 1, 2}, {3, 3, 3}, kLinear).has_kinks());
}

// An odd number of kinks in a period: the signs at the same place of two successive periods differ.
TEST(TableFunction, SwitchesAtItsKinksInEveryPeriod) {
  const TableFunction odd({0, 1, 2.5}, {0, 2, 7}, kLinear, kHold, 4), even({0, 1, 2, 3}, {0, 1, 4, 1}, kLinear, kHold, 4);
  expect_sign_changes(odd, {-4, -3, -1.5, 0, 1, 2.5, 4, 5, 6.5}, -4.9995, 7.9);
  expect_sign_changes(even, {-4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, -4.9995, 7.9);
}

TEST(TableFunction, RefusesWhatIsNoFunction) {
  EXPECT_THROW(TableFunction({1}, {1}, kLinear), std::invalid_argument);
  EXPECT_THROW(TableFunction({1, 2}, {1}, kLinear), std::invalid_argument);
  EXPECT_THROW(TableFunction({1, 1}, {1, 2}, kLinear), std::invalid_argument);
  EXPECT_THROW(TableFunction({0, 3}, {1, 1}, kLinear, kHold, 2), std::invalid_argument);
}

TEST(TableFunction, PassesOnWhatIsNoNumber) {
  for (const auto interpolation : kAll) EXPECT_TRUE(std::isnan(wave(5, interpolation, true).value(std::nan(""))));
}

}  // namespace
}  // namespace pintle
