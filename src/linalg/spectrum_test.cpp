// The numbers of a spectrum against the standard library's, one by one.
#include "linalg/spectrum.h"

#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <type_traits>

#include "base/random_for_tests.h"

namespace pintle {
namespace {

using sample::Random;
using Number = std::complex<double>;

template <class Size>
class AnySpectrum : public testing::Test {
 protected:
  static constexpr int N = Size::value, kNumbers = N / 2 + 1;
  using X = Spectrum<N>;
  Random random_{31};

  X at_random() {
    X x;
    for (int i = 0; i < N; ++i) x.x.set(i, random_.of_any_size(1e-2, 1e2));
    return x;
  }
  // The complex numbers, then the real one.
  static Number number(const X& x, int i) { return 2 * i == N - 1 ? Number(x.x[N - 1]) : Number(x.x[2 * i], x.x[2 * i + 1]); }
  template <class F>
  static void expect_numbers(const X& found, F&& expected) {
    for (int i = 0; i < kNumbers; ++i) {
      const Number e = expected(i);
      EXPECT_LE(std::abs(number(found, i) - e), 1e-15 * std::abs(e)) << i;
    }
    for (int i = N; i < Lanes<N>::kWidth; ++i) EXPECT_EQ(found.x.v[i], found.x[N - 1]) << i;
  }
};
using Sizes = testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 5>>;
TYPED_TEST_SUITE(AnySpectrum, Sizes);

TYPED_TEST(AnySpectrum, ArithmeticIsThatOfEachNumber) {
  for (int again = 0; again < 200; ++again) {
    const auto a = this->at_random(), b = this->at_random();
    const double f = this->random_.of_any_size(0.1, 10);
    const auto of = [](const auto& x, int i) { return TestFixture::number(x, i); };
    this->expect_numbers(a * b, [&](int i) { return of(a, i) * of(b, i); });
    this->expect_numbers(reciprocal(a), [&](int i) { return 1.0 / of(a, i); });
    this->expect_numbers(f * a, [&](int i) { return f * of(a, i); });
    this->expect_numbers(a + b, [&](int i) { return of(a, i) + of(b, i); });
    this->expect_numbers(a - b, [&](int i) { return of(a, i) - of(b, i); });
    this->expect_numbers(-a, [&](int i) { return -of(a, i); });
    auto c = a;
    c += b;
    this->expect_numbers(c, [&](int i) { return of(a, i) + of(b, i); });
    c -= b;
    c -= a;
    for (int i = 0; i < TestFixture::kNumbers; ++i) EXPECT_LE(std::abs(of(c, i)), 1e-15 * (std::abs(of(a, i)) + std::abs(of(b, i))));
  }
}

TYPED_TEST(AnySpectrum, RealNumberIsTheSameInAll) {
  this->expect_numbers(typename TestFixture::X(-3.5), [](int) { return -3.5; });
  const auto a = this->at_random();
  this->expect_numbers(typename TestFixture::X(1.0) * a, [&](int i) { return TestFixture::number(a, i); });
}

TYPED_TEST(AnySpectrum, IsFiniteWhenEveryNumberIs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite(this->at_random()));
  EXPECT_TRUE(is_finite(typename TestFixture::X(0.0)));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity})
    for (int i = 0; i < TestFixture::N; ++i) {
      auto x = this->at_random();
      x.x.set(i, bad);
      EXPECT_FALSE(is_finite(x)) << bad << " in lane " << i;
    }
}

}  // namespace
}  // namespace pintle
