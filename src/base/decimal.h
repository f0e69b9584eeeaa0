// A decimal number from text, correctly rounded, whatever the locale and whether or not the standard library can.
#pragma once

#include <string_view>

namespace pintle {

struct Decimal {
  double value = 0;       // beyond the range of doubles: infinity, or zero
  bool whole = false;     // all of the text was the number
  bool in_range = false;
};

Decimal read_decimal(std::string_view text);

}  // namespace pintle
