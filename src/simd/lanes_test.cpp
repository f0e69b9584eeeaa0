// Lanes against single numbers, their matrices against Eigen's, sine and cosine against the standard library's.
#include "simd/lanes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <vector>

#include "base/random_for_tests.h"
#include "simd/processor_registers.h"

namespace pintle {
namespace {

using sample::Random;

template <class Size>
class AnyLanes : public testing::Test {
 protected:
  static constexpr int N = Size::value;
  using L = Lanes<N>;
  Random random_{21};

  L at_random() {
    L x;
    for (int i = 0; i < N; ++i) x.set(i, random_.of_any_size(1e-3, 1e3));
    return x;
  }
  // In every lane, and in the unused part of the register.
  template <class F>
  static void expect_lanes(const L& found, F&& expected) {
    for (int i = 0; i < N; ++i) EXPECT_EQ(found[i], expected(i)) << i;
    for (int i = N; i < L::kWidth; ++i) EXPECT_EQ(found.v[i], expected(N - 1)) << i;
  }
};
using Sizes = testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 3>, std::integral_constant<int, 5>>;
TYPED_TEST_SUITE(AnyLanes, Sizes);

TYPED_TEST(AnyLanes, ArithmeticIsThatOfNumbers) {
  for (int again = 0; again < 100; ++again) {
    const auto a = this->at_random(), b = this->at_random();
    const double x = this->random_.uniform(-3, 3);
    this->expect_lanes(a + b, [&](int i) { return a[i] + b[i]; });
    this->expect_lanes(a - b, [&](int i) { return a[i] - b[i]; });
    this->expect_lanes(a * b, [&](int i) { return a[i] * b[i]; });
    this->expect_lanes(-a, [&](int i) { return -a[i]; });
    this->expect_lanes(x * a, [&](int i) { return x * a[i]; });
    this->expect_lanes(a * x, [&](int i) { return x * a[i]; });
    auto c = a;
    this->expect_lanes(c += b, [&](int i) { return a[i] + b[i]; });
    c = a;
    this->expect_lanes(c -= b, [&](int i) { return a[i] - b[i]; });
    c = a;
    this->expect_lanes(c *= b, [&](int i) { return a[i] * b[i]; });
  }
}

TYPED_TEST(AnyLanes, AllPutsTheSameEverywhere) {
  this->expect_lanes(TestFixture::L::all(-2.5), [](int) { return -2.5; });
}

TYPED_TEST(AnyLanes, SetChangesOneLaneAndThePadFollowsTheLast) {
  constexpr int n = TestFixture::N;
  for (int changed = 0; changed < n; ++changed) {
    const auto before = this->at_random();
    auto after = before;
    after.set(changed, 7.25);
    this->expect_lanes(after, [&](int i) { return i == changed ? 7.25 : before[i]; });
  }
}

TYPED_TEST(AnyLanes, LargerSizeIsTheLargestMagnitude) {
  for (int again = 0; again < 100; ++again) {
    const auto a = this->at_random(), b = this->at_random(), c = this->at_random();
    const auto size = larger_size(larger_size(larger_size(TestFixture::L::all(0), a), b), c);
    this->expect_lanes(size, [&](int i) { return std::max({std::abs(a[i]), std::abs(b[i]), std::abs(c[i])}); });
  }
}

#if PINTLE_BUILDS_256
template <int N>
using Four = std::array<Lanes<N>, 4>;

template <int N>
PINTLE_LANES void use(const Lanes<N>& a, const Lanes<N>& b, Four<N>& out) {
  out[0] = a * b - 3.5 * a + b;
  out[1] = larger_size(larger_size(Lanes<N>::all(0), a), b);
  sine_and_cosine(a, out[2], out[3]);
}
template <int N>
PINTLE_WIDE void use_wide(const Lanes<N>& a, const Lanes<N>& b, Four<N>& out) {
  use(a, b, out);
}

// With any registers the bits are the same.
TYPED_TEST(AnyLanes, WideRegistersMakeNoDifference) {
  if (!has_wide_registers()) GTEST_SKIP() << "this processor has none";
  for (int again = 0; again < 1000; ++again) {
    const auto a = this->at_random(), b = this->at_random();
    Four<TestFixture::N> narrow, wide;
    use(a, b, narrow);
    use_wide(a, b, wide);
    for (int k = 0; k < 4; ++k) this->expect_lanes(wide[k], [&](int i) { return narrow[k][i]; });
  }
}
#endif

TEST(Lanes, TransposedRowsAreColumns) {
  Lanes<4> rows[4];
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) rows[i].set(k, 10 * i + k);
  transpose(rows);
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) EXPECT_EQ(rows[i][k], 10 * k + i);
}

TYPED_TEST(AnyLanes, MatricesAreThoseOfEigen) {
  constexpr int n = TestFixture::N;
  for (int again = 0; again < 100; ++again) {
    const Eigen::Matrix<double, n, n> dense = Eigen::Matrix<double, n, n>::NullaryExpr([&] { return this->random_.uniform(-1, 1); });
    LaneMatrix<n> m;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) m.column[k].set(i, dense(i, k));
    const auto x = this->at_random();
    Eigen::Matrix<double, n, 1> dense_x;
    for (int i = 0; i < n; ++i) dense_x[i] = x[i];
    const Eigen::Matrix<double, n, 1> expected = dense * dense_x;
    const auto y = m * x;
    for (int i = 0; i < n; ++i) EXPECT_NEAR(y[i], expected[i], 2e-15 * dense_x.cwiseAbs().maxCoeff());
    for (int i = n; i < TestFixture::L::kWidth; ++i) EXPECT_EQ(y.v[i], y[n - 1]);
  }
}

TYPED_TEST(AnyLanes, SineAndCosineReachEveryLane) {
  const auto angle = this->at_random();
  typename TestFixture::L sine, cosine;
  sine_and_cosine(angle, sine, cosine);
  for (int i = 0; i < TestFixture::N; ++i) {
    EXPECT_NEAR(sine[i], std::sin(angle[i]), 2.3e-16) << angle[i];
    EXPECT_NEAR(cosine[i], std::cos(angle[i]), 2.3e-16) << angle[i];
  }
  for (int i = TestFixture::N; i < TestFixture::L::kWidth; ++i) {
    EXPECT_EQ(sine.v[i], sine[TestFixture::N - 1]);
    EXPECT_EQ(cosine.v[i], cosine[TestFixture::N - 1]);
  }
}

// The larger of the errors of sine and cosine at x, in any lane, with another angle in the others.
double error_at(double x, double beside) {
  double worst = 0;
  for (const int lane : {0, 1, 2}) {
    Lanes<3> angle = Lanes<3>::all(beside), sine, cosine;
    angle.set(lane, x);
    sine_and_cosine(angle, sine, cosine);
    worst = std::max({worst, std::abs(sine[lane] - std::sin(x)), std::abs(cosine[lane] - std::cos(x))});
  }
  return worst;
}

double worst_error(const std::vector<double>& angles) {
  double worst = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) worst = std::max(worst, error_at(angles[i], angles[(7 * i + 1) % angles.size()]));
  return worst;
}

// Measured: one unit in the last place between 1/2 and 1, 1.1e-16; compared with exact values 1.21e-16.
constexpr double kError = 2.3e-16, kExactError = std::numeric_limits<long double>::digits > 53 ? 1.25e-16 : kError;

TEST(SineAndCosine, AreThoseOfTheStandardLibrary) {
  Random random(22);
  for (const double largest : {1.0, 7.0, 1e3, kLargestAngle}) {
    std::vector<double> angles(100000);
    for (double& x : angles) x = random.uniform(-largest, largest);
    EXPECT_LE(worst_error(angles), kError) << largest;
  }
}

// The last half bit, if the standard library has a type with more digits.
TEST(SineAndCosine, AreExactToAUnitInTheLastPlace) {
  Random random(26);
  double worst = 0;
  for (const double largest : {1.0, 7.0, 1e3, kLargestAngle})
    for (int i = 0; i < 50000; ++i) {
      const double x = random.uniform(-largest, largest);
      Lanes<3> sine, cosine;
      sine_and_cosine(Lanes<3>::of({x, -x, x}), sine, cosine);
      const long double exact = x;
      worst = std::max({worst, static_cast<double>(std::abs(sine[0] - std::sin(exact))), static_cast<double>(std::abs(cosine[1] - std::cos(exact)))});
    }
  EXPECT_LE(worst, kExactError);
}

// Where the quarter turn changes, and where sine or cosine vanish and the reduction cancels every digit.
TEST(SineAndCosine, HoldAroundMultiplesOfAnEighthTurn) {
  Random random(23);
  constexpr double kEighth = std::numbers::pi / 4, kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> angles;
  const auto add_around = [&](int n) {
    const double x = n * kEighth;
    if (std::abs(x) > kLargestAngle - 1) return;
    angles.insert(angles.end(), {x, std::nextafter(x, kInfinity), std::nextafter(x, -kInfinity), x + random.of_any_size(1e-17, 1e-2)});
  };
  for (int n = -1000; n <= 1000; ++n) add_around(n);
  for (int i = 0; i < 20000; ++i) add_around(random.below(260000) - 130000);
  EXPECT_LE(worst_error(angles), kError);
}

TEST(SineAndCosine, HoldAtZeroAndAtTinyAngles) {
  Random random(24);
  std::vector<double> angles{0.0, -0.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::min()};
  for (int i = 0; i < 10000; ++i) angles.push_back(random.of_any_size(1e-300, 1e-3));
  for (const double x : angles) {
    Lanes<3> sine, cosine;
    sine_and_cosine(Lanes<3>::of({x, -x, x}), sine, cosine);
    for (const int lane : {0, 1}) {
      const double angle = lane == 0 ? x : -x;
      EXPECT_LE(std::abs(sine[lane] - std::sin(angle)), 2.3e-16 * std::abs(angle)) << angle;  // a relative error here
      EXPECT_LE(std::abs(cosine[lane] - std::cos(angle)), kError) << angle;
    }
  }
}

TEST(SineAndCosine, AngleThatIsTooLargeIsLeftToTheStandardLibrary) {
  Random random(25);
  std::vector<double> angles{kLargestAngle, -kLargestAngle, 1e22, -1e300, std::numeric_limits<double>::max()};
  for (int i = 0; i < 1000; ++i) angles.push_back(random.of_any_size(kLargestAngle, 1e18));
  for (const double x : angles) {
    EXPECT_EQ(error_at(x, 0.4), 0) << x;
    EXPECT_LE(error_at(0.4, x), kError) << x;  // and does not affect its neighbour
  }
  EXPECT_LE(error_at(std::nextafter(kLargestAngle, 0), 0.4), kError);
}

TEST(SineAndCosine, WhatIsNotFiniteHasNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity})
    for (const int lane : {0, 1, 2}) {
      Lanes<3> angle = Lanes<3>::all(1.25), sine, cosine;
      angle.set(lane, bad);
      sine_and_cosine(angle, sine, cosine);
      EXPECT_TRUE(std::isnan(sine[lane]) && std::isnan(cosine[lane])) << bad;
      EXPECT_NEAR(sine[(lane + 1) % 3], std::sin(1.25), kError);
      EXPECT_NEAR(cosine[(lane + 2) % 3], std::cos(1.25), kError);
    }
}

}  // namespace
}  // namespace pintle
