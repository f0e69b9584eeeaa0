#include "io/toml/toml_lexer.h"

#include <algorithm>

namespace pintle {
namespace {

// Length of the string at the start of `text`, including its quotes.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const bool escapes = quote == '"';
  const bool block = text.size() >= 3 && text[1] == quote && text[2] == quote;
  std::size_t at = block ? 3 : 1;
  while (at < text.size()) {
    if (escapes && text[at] == '\\') {
      at += 2;
    } else if (!block && text[at] == '\n') {
      return at;  // not closed: the parser will report it
    } else if (text[at] != quote) {
      ++at;
    } else if (!block) {
      return at + 1;
    } else {
      const std::size_t run = std::min(text.find_first_not_of(quote, at), text.size()) - at;
      at += std::min<std::size_t>(run, 5);  // up to two quotes may precede the closing three
      if (run >= 3) return at;
    }
  }
  return text.size();
}

std::size_t run_length(std::string_view text, std::string_view stops) {
  return std::max<std::size_t>(1, std::min(text.find_first_of(stops), text.size()));
}

}  // namespace

Token next_toml_token(std::string_view text) {
  const auto piece = [&](TokenKind kind, std::size_t length) { return Token{kind, text.substr(0, length)}; };
  switch (text.front()) {
    case ' ':
    case '\t':
      return piece(TokenKind::kSpace, std::min(text.find_first_not_of(" \t"), text.size()));
    case '\r':
      return text.starts_with("\r\n") ? piece(TokenKind::kNewline, 2) : piece(TokenKind::kBare, 1);
    case '\n':
      return piece(TokenKind::kNewline, 1);
    case '#':
      return piece(TokenKind::kComment, run_length(text, "\r\n"));
    case '"':
    case '\'':
      return piece(TokenKind::kString, string_length(text));
    case '[':
    case '{':
      return piece(TokenKind::kOpen, 1);
    case ']':
    case '}':
      return piece(TokenKind::kClose, 1);
    case '=':
      return piece(TokenKind::kEquals, 1);
    case ',':
      return piece(TokenKind::kComma, 1);
    default:
      return piece(TokenKind::kBare, run_length(text, " \t\r\n#\"'[]{}=,"));
  }
}

std::vector<Token> cut_toml(std::string_view text) {
  std::vector<Token> tokens;
  while (!text.empty()) {
    tokens.push_back(next_toml_token(text));
    text.remove_prefix(tokens.back().text.size());
  }
  return tokens;
}

}  // namespace pintle
