#include "base/decimal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pintle {
namespace {

TEST(Decimal, ReadsTheNearestDouble) {
  EXPECT_EQ(read_decimal("0.1").value, 0.1);
  EXPECT_EQ(read_decimal("-2.5e-3").value, -2.5e-3);
  EXPECT_EQ(read_decimal("1.7976931348623157e308").value, std::numeric_limits<double>::max());
  EXPECT_TRUE(read_decimal("0.1").whole);
  EXPECT_TRUE(read_decimal("0.1").in_range);
}

TEST(Decimal, SaysWhatIsNoNumber) {
  for (const char* text : {"", "x", "1x", "1 ", "1,5"}) EXPECT_FALSE(read_decimal(text).whole) << text;
}

TEST(Decimal, GivesInfinityAndZeroBeyondTheRange) {
  const Decimal large = read_decimal("1e999"), small = read_decimal("1e-999");
  EXPECT_TRUE(large.whole && small.whole);
  EXPECT_FALSE(large.in_range);
  EXPECT_FALSE(small.in_range);
  EXPECT_TRUE(std::isinf(large.value));
  EXPECT_EQ(small.value, 0);
}

}  // namespace
}  // namespace pintle
