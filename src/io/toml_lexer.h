// TOML text cut into pieces, none lost: what the formatter moves about, and the guard against endless dotted keys.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "io/document.h"

namespace pintle {

enum class TokenKind { kSpace, kNewline, kComment, kString, kBare, kOpen, kClose, kEquals, kComma };

/// A piece of the text. kOpen and kClose are one bracket or brace; kBare is a key, number, date or word with its dots.
struct Token {
  TokenKind kind;
  std::string_view text;
};

/// Cuts `text` without checking its grammar; the pieces joined are `text`.
std::vector<Token> cut_toml(std::string_view text);

/// Where a key of more than kMaxDepth dotted parts starts, if there is one. (The parser would nest that many tables.)
std::optional<Spot> first_deep_key(std::string_view text);

}  // namespace pintle
