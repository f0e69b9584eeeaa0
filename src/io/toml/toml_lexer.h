// Cuts TOML text into pieces without losing any, for the formatter and for the guard before the parser.
#pragma once

#include <string_view>
#include <vector>

namespace pintle {

enum class TokenKind { kSpace, kNewline, kComment, kString, kBare, kOpen, kClose, kEquals, kComma };

/// A piece of the text. kOpen and kClose are one bracket or brace; kBare is a key, number, date or word with its dots.
struct Token {
  TokenKind kind;
  std::string_view text;
};

/// The first piece of `text`, which must not be empty.
Token next_toml_token(std::string_view text);

/// Cuts `text` without checking its grammar; concatenating the pieces gives `text` again.
std::vector<Token> cut_toml(std::string_view text);

}  // namespace pintle
