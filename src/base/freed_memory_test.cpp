#include "base/freed_memory.h"

#include <gtest/gtest.h>

#include <vector>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PINTLE_OTHER_MALLOC
#endif
#endif
#ifndef PINTLE_OTHER_MALLOC
#include <sys/resource.h>

namespace pintle {
namespace {

long pages_handed_out() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use.ru_minflt;
}

// The memory of a start or a step: some arrays of a megabyte.
double fill_and_free() {
  std::vector<std::vector<double>> arrays(8);
  for (auto& x : arrays) x.assign(1 << 17, 1.0);
  return arrays.back().back();
}

long pages_for(int times) {
  const long before = pages_handed_out();
  double sum = 0;
  for (int i = 0; i < times; ++i) sum += fill_and_free();
  EXPECT_EQ(sum, times);
  return pages_handed_out() - before;
}

TEST(FreedMemory, IsTakenAgain) {
  keep_freed_memory();
  pages_for(1);
  EXPECT_LT(pages_for(10), 100);  // one filling is 2048 pages of 4 KiB
}

}  // namespace
}  // namespace pintle
#endif
#endif
