// SHA-256 (FIPS 180-4), to identify the input of a run.
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace pintle
