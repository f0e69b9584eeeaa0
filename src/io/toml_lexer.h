// TOML text cut into pieces, none lost: what the formatter moves about, and a guard in front of the parser.
#pragma once

#include <optional>
#include <string>
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

/// What is wrong with a text before its grammar is looked at.
struct LexicalProblem {
  Spot spot;
  std::string found;
  std::string because;
};

/// The first thing that must not reach toml++ 3.3, which takes it for granted rather than refusing it: a key of more than
/// kMaxDepth dotted parts, a character outside strings and comments that TOML has no use for there, a header without a key.
std::optional<LexicalProblem> first_lexical_problem(std::string_view text);

}  // namespace pintle
