// A short name for a text: says whether two runs read the same input, not a defence against forgery.
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// The 64-bit FNV-1a hash of the bytes, as 16 hexadecimal digits; the same on every machine.
std::string input_hash(std::string_view text);

}  // namespace pintle
