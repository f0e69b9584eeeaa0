// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3, SC'11): a random function of a counter
// and a key, so that the numbers of a sample do not depend on the order in which numbers are requested.
#pragma once

#include <array>
#include <cstdint>

namespace pintle {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

constexpr PhiloxCounter philox(PhiloxCounter c, PhiloxKey k) {
  constexpr std::uint64_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57;
  constexpr std::uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = kMultiplier0 * c[0], b = kMultiplier1 * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(a)};
    k = {k[0] + kWeyl0, k[1] + kWeyl1};
  }
  return c;
}

/// A number in the open interval (0, 1), for variable `stream` in sample `index`: one of 2^53 equally likely values.
constexpr double uniform_number(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  const PhiloxCounter bits = philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                                     static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)},
                                    {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  const std::uint64_t word = (std::uint64_t{bits[0]} << 32 | bits[1]) >> 11;
  return (static_cast<double>(word) + 0.5) * 0x1p-53;
}

}  // namespace pintle
