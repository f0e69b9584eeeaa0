#include "io/toml_lexer.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/utf8.h"
#include "io/text.h"

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
    case '\r': return text.starts_with("\r\n") ? piece(TokenKind::kNewline, 2) : piece(TokenKind::kBare, 1);
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

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

// Reads the pieces one after the other and remembers what the next one may be.
class Guard {
 public:
  std::optional<LexicalProblem> look_at(const Token& token) {
    std::optional<LexicalProblem> problem = wrong_character(token);
    if (!problem) problem = deep_key(token);
    if (!problem) problem = empty_header(token);
    move_past(token);
    return problem;
  }

 private:
  enum class Header { kNo, kFirstBracket, kSecondBracket };

  std::optional<LexicalProblem> wrong_character(const Token& token) const {
    if (token.kind != TokenKind::kBare) return std::nullopt;
    const auto wrong = std::find_if(token.text.begin(), token.text.end(), [](char c) {
      return !is_key_character(c) && c != '.' && c != '+' && c != ':';
    });
    if (wrong == token.text.end()) return std::nullopt;
    const auto before = static_cast<std::size_t>(wrong - token.text.begin());
    const std::string_view character = character_at(token.text, before);
    const Spot spot{0, spot_.line, spot_.column + static_cast<int>(count_characters(token.text.substr(0, before)))};
    return LexicalProblem{spot, quoted(character), "this character must stand in quotes"};
  }

  std::optional<LexicalProblem> deep_key(const Token& token) {
    const bool in_key = token.kind == TokenKind::kBare || token.kind == TokenKind::kString;
    if (!in_key && token.kind != TokenKind::kSpace) dots_ = 0;
    if (in_key && dots_ == 0) key_start_ = spot_;
    if (token.kind == TokenKind::kBare) dots_ += std::count(token.text.begin(), token.text.end(), '.');
    if (dots_ <= kMaxDepth) return std::nullopt;
    return LexicalProblem{key_start_, "a key of too many dotted parts", "at most 64 levels are read"};
  }

  std::optional<LexicalProblem> empty_header(const Token& token) {
    if (token.kind == TokenKind::kSpace) return std::nullopt;
    const bool at_start = at_start_;
    at_start_ = token.kind == TokenKind::kNewline && depth_ <= 0;
    const Header before = std::exchange(header_, Header::kNo);
    if (token.text == "[" && at_start) {
      header_ = Header::kFirstBracket;
    } else if (token.text == "[" && before == Header::kFirstBracket) {
      header_ = Header::kSecondBracket;
    } else if (before != Header::kNo) {
      const bool is_key = token.kind == TokenKind::kString || is_key_character(token.text.front());
      if (!is_key) return LexicalProblem{spot_, "a header without a name", "a header is [name] or [[name]]"};
    }
    return std::nullopt;
  }

  void move_past(const Token& token) {
    if (token.kind == TokenKind::kOpen) ++depth_;
    if (token.kind == TokenKind::kClose) --depth_;
    const auto lines = static_cast<int>(std::count(token.text.begin(), token.text.end(), '\n'));
    spot_.line += lines;
    const std::string_view last_line = token.text.substr(token.text.rfind('\n') + 1);
    spot_.column = (lines > 0 ? 1 : spot_.column) + static_cast<int>(count_characters(last_line));
  }

  Spot spot_{0, 1, 1};
  Spot key_start_;
  std::ptrdiff_t dots_ = 0;
  int depth_ = 0;
  bool at_start_ = true;
  Header header_ = Header::kNo;
};

}  // namespace

std::vector<Token> cut_toml(std::string_view text) {
  std::vector<Token> tokens;
  while (!text.empty()) {
    tokens.push_back(next_token(text));
    text.remove_prefix(tokens.back().text.size());
  }
  return tokens;
}

std::optional<LexicalProblem> first_lexical_problem(std::string_view text) {
  Guard guard;
  while (!text.empty()) {
    const Token token = next_token(text);
    if (std::optional<LexicalProblem> problem = guard.look_at(token)) return problem;
    text.remove_prefix(token.text.size());
  }
  return std::nullopt;
}

}  // namespace pintle
