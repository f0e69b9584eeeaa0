// Counting and cutting text by characters rather than bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pintle {

/// Number of characters (code points) in `text`; a stray byte counts as one.
std::size_t count_characters(std::string_view text);

/// The character that starts at byte `offset` (all its bytes; empty at the end).
std::string_view character_at(std::string_view text, std::size_t offset);

/// `text` with every control character except the tab replaced by a blank, safe to print.
std::string printable(std::string_view text);

}  // namespace pintle
