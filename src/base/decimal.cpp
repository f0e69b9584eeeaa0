#include "base/decimal.h"

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

namespace pintle {

Decimal read_decimal(std::string_view text) {
  Decimal out;
#ifdef __cpp_lib_to_chars
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, out.value);
  out.whole = end == last && error != std::errc::invalid_argument;
  out.in_range = error == std::errc();
  if (error == std::errc::result_out_of_range) out.value = std::strtod(std::string(text).c_str(), nullptr);
#else
  const std::string copy(text);
  char* end = nullptr;
  errno = 0;
  out.value = std::strtod(copy.c_str(), &end);
  out.whole = !copy.empty() && end == copy.c_str() + copy.size();
  out.in_range = out.whole && errno != ERANGE;
#endif
  return out;
}

}  // namespace pintle
