// A decimal number from text, correctly rounded, independent of the locale and of what the standard library supports.
#pragma once

#include <string_view>

namespace pintle {

struct Decimal {
  double value = 0;       // beyond the range of doubles: infinity, or zero
  bool whole = false;     // the number was the whole text
  bool in_range = false;
};

Decimal read_decimal(std::string_view text);

}  // namespace pintle
