// Explicit prefetching. A step traverses a dozen arrays at once, forward and backward, which hardware prefetchers do
// not predict; without this, large mechanisms wait for memory half of the time.
#pragma once

#include <cstddef>
#include <vector>

#include "simd/lanes.h"

namespace pintle {

/// Number of bodies that no longer fit into the second-level cache: mechanisms with more use prefetching.
constexpr std::size_t kLargeMechanism = 1000;

/// Prefetches entries [i, i + n) of x, if they exist, which will be read or written soon.
template <class T>
PINTLE_LANES void fetch(const std::vector<T>& x, std::size_t i, std::size_t n = 1) {
  constexpr std::size_t kLine = 64;
  if (i + n > x.size()) return;
  const char *p = reinterpret_cast<const char*>(&x[i]), *const end = reinterpret_cast<const char*>(&x[i] + n);
  for (; p < end; p += kLine) __builtin_prefetch(p, 1, 2);
}

}  // namespace pintle
