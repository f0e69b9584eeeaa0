#include "io/toml_lexer.h"

#include <algorithm>

#include "base/utf8.h"

namespace pintle {
namespace {

// Length of the string that starts at the head of `text`, its quotes included.
std::size_t string_length(std::string_view text) {
  const char quote = text.front();
  const bool escapes = quote == '"';
  const bool block = text.size() >= 3 && text[1] == quote && text[2] == quote;
  std::size_t at = block ? 3 : 1;
  while (at < text.size()) {
    if (escapes && text[at] == '\\') {
      at += 2;
    } else if (!block && text[at] == '\n') {
      return at;  // not closed: the parser will say so
    } else if (text[at] != quote) {
      ++at;
    } else if (!block) {
      return at + 1;
    } else {
      const std::size_t run = std::min(text.find_first_not_of(quote, at), text.size()) - at;
      at += std::min<std::size_t>(run, 5);  // up to two quotes may stand before the closing three
      if (run >= 3) return at;
    }
  }
  return text.size();
}

std::size_t run_length(std::string_view text, std::string_view stops) {
  return std::max<std::size_t>(1, std::min(text.find_first_of(stops), text.size()));
}

Token next_token(std::string_view text) {
  const auto piece = [&](TokenKind kind, std::size_t length) { return Token{kind, text.substr(0, length)}; };
  switch (text.front()) {
    case ' ':
    case '\t': return piece(TokenKind::kSpace, std::min(text.find_first_not_of(" \t"), text.size()));
    case '\r': return text.starts_with("\r\n") ? piece(TokenKind::kNewline, 2) : piece(TokenKind::kSpace, 1);
    case '\n': return piece(TokenKind::kNewline, 1);
    case '#': return piece(TokenKind::kComment, run_length(text, "\r\n"));
    case '"':
    case '\'': return piece(TokenKind::kString, string_length(text));
    case '[':
    case '{': return piece(TokenKind::kOpen, 1);
    case ']':
    case '}': return piece(TokenKind::kClose, 1);
    case '=': return piece(TokenKind::kEquals, 1);
    case ',': return piece(TokenKind::kComma, 1);
    default: return piece(TokenKind::kBare, run_length(text, " \t\r\n#\"'[]{}=,"));
  }
}

}  // namespace

std::vector<Token> cut_toml(std::string_view text) {
  std::vector<Token> tokens;
  while (!text.empty()) {
    tokens.push_back(next_token(text));
    text.remove_prefix(tokens.back().text.size());
  }
  return tokens;
}

std::optional<Spot> first_deep_key(std::string_view text) {
  Spot spot{0, 1, 1};
  Spot key_start = spot;
  std::ptrdiff_t dots = 0;
  while (!text.empty()) {
    const Token token = next_token(text);
    const bool in_key = token.kind == TokenKind::kBare || token.kind == TokenKind::kString;
    if (!in_key && token.kind != TokenKind::kSpace) dots = 0;
    if (in_key && dots == 0) key_start = spot;
    if (token.kind == TokenKind::kBare) dots += std::count(token.text.begin(), token.text.end(), '.');
    if (dots > kMaxDepth) return key_start;
    const auto lines = static_cast<int>(std::count(token.text.begin(), token.text.end(), '\n'));
    spot.line += lines;
    const std::string_view last_line = token.text.substr(token.text.rfind('\n') + 1);
    spot.column = (lines > 0 ? 1 : spot.column) + static_cast<int>(count_characters(last_line));
    text.remove_prefix(token.text.size());
  }
  return std::nullopt;
}

}  // namespace pintle
