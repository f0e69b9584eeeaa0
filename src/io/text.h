// Characters, quoting and numbers as text, for the readers and writers of model files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pintle {

struct Node;

inline bool is_continuation_byte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Byte offset of the first byte that is not well-formed UTF-8, if any.
std::optional<std::size_t> first_invalid_utf8(std::string_view text);

/// Appends a code point as UTF-8.
void append_utf8(std::string& text, std::uint32_t code_point);

/// Number of UTF-8 bytes of the code point given in hexadecimal digits. A surrogate counts as 2 (a pair makes 4).
std::size_t utf8_length_of_hex(std::string_view digits);

/// The value of 4 or 8 hexadecimal digits, if all are such digits.
std::optional<std::uint32_t> hex_value(std::string_view digits);

/// In double quotes, with line ends shown as \n, cut after 60 bytes.
std::string in_quotes(std::string_view text);

/// In double quotes, with escapes that TOML and JSON share.
std::string quoted_exactly(std::string_view text);

/// An integer or a float as text that reads back to the same value and kind.
std::string number_text(const Node& number);
std::string number_text(double number);

/// Letters, digits, _ and -: a TOML bare key, and the characters allowed in names of things.
bool is_bare_key(std::string_view key);

}  // namespace pintle
