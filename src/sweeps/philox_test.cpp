// The random numbers: the published test vectors, and properties of a uniform distribution.
#include "sweeps/philox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pintle {
namespace {

// Known answers from the authors' own program (Random123, kat_vectors, philox4x32 with 10 rounds).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}), (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The largest distance of the empirical distribution from the uniform one exceeds 1.95 / sqrt(n) once in a thousand cases.
TEST(Philox, NumbersAreEvenlySpread) {
  constexpr std::size_t kN = 20000;
  for (const std::uint64_t stream : {1ULL, 2ULL, 0xffffffffffffULL}) {
    std::vector<double> x(kN);
    for (std::size_t i = 0; i < kN; ++i) x[i] = uniform_number(7, stream, i);
    std::sort(x.begin(), x.end());
    double distance = 0;
    for (std::size_t i = 0; i < kN; ++i) distance = std::max({distance, x[i] - static_cast<double>(i) / kN, static_cast<double>(i + 1) / kN - x[i]});
    EXPECT_LT(distance, 1.95 / std::sqrt(static_cast<double>(kN)));
    EXPECT_GT(x.front(), 0);
    EXPECT_LT(x.back(), 1);
  }
}

TEST(Philox, StreamsAndNeighboursAreNotCorrelated) {
  constexpr std::size_t kN = 20000;
  double between = 0, along = 0;
  for (std::size_t i = 0; i < kN; ++i) {
    const double a = uniform_number(1, 10, i) - 0.5;
    between += a * (uniform_number(1, 11, i) - 0.5);
    along += a * (uniform_number(1, 10, i + 1) - 0.5);
  }
  const double deviation = std::sqrt(static_cast<double>(kN)) / 12;
  EXPECT_LT(std::abs(between), 4 * deviation);
  EXPECT_LT(std::abs(along), 4 * deviation);
}

}  // namespace
}  // namespace pintle
