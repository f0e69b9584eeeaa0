// SHA-256 (FIPS 180-4), to name the input that a run came from.
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace pintle
