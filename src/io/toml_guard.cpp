#include "io/toml_guard.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "base/utf8.h"
#include "io/text.h"
#include "io/toml_lexer.h"

namespace pintle {
namespace {

bool is_key_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

bool starts_key(const Token& token) {
  return token.kind == TokenKind::kString || (token.kind == TokenKind::kBare && is_key_character(token.text.front()));
}

// Walks over the pieces; `expect_` says what may come next, `open_` which lists and inline tables are not yet closed.
class Guard {
 public:
  // Why `token` is wrong here; empty if it is not.
  std::optional<TomlProblem> look_at(const Token& token) {
    std::optional<TomlProblem> problem = wrong_character(token);
    if (!problem) problem = deep_key(token);
    if (!problem && token.kind != TokenKind::kSpace) problem = misplaced(token);
    move_past(token);
    return problem;
  }

  std::optional<TomlProblem> look_at_end() const {
    const bool complete = expect_ == Expect::kLine || expect_ == Expect::kHeaderEnd ||
                          (expect_ == Expect::kAfterValue && open_.empty());
    if (complete) return std::nullopt;
    return TomlProblem{spot_, "the end of the file", std::string("expected ") + wanted()};
  }

 private:
  enum class Expect { kLine, kHeader, kHeaderKey, kHeaderEnd, kEquals, kValue, kFirstInlineKey, kInlineKey, kAfterValue };

  const char* wanted() const {
    switch (expect_) {
      case Expect::kLine: return "a key or a [header]";
      case Expect::kHeader: return "a name in the header";
      case Expect::kHeaderKey: return "] after the name";
      case Expect::kHeaderEnd: return "the end of the line";
      case Expect::kEquals: return "= after the key";
      case Expect::kValue: return "a value";
      case Expect::kFirstInlineKey:
      case Expect::kInlineKey: return "a key";
      case Expect::kAfterValue: break;
    }
    if (open_.empty()) return "the end of the line after the value";
    return open_.back() == '[' ? "a comma or ] after the value" : "a comma or } after the value";
  }

  std::optional<TomlProblem> wrong_character(const Token& token) const {
    if (token.kind != TokenKind::kBare) return std::nullopt;
    const auto wrong = std::find_if(token.text.begin(), token.text.end(), [](char c) {
      return !is_key_character(c) && c != '.' && c != '+' && c != ':';
    });
    if (wrong == token.text.end()) return std::nullopt;
    const auto before = static_cast<std::size_t>(wrong - token.text.begin());
    const Spot spot{0, spot_.line, spot_.column + static_cast<int>(before)};  // what stands before is ASCII
    return TomlProblem{spot, quoted(character_at(token.text, before)), "this character must stand in quotes"};
  }

  std::optional<TomlProblem> deep_key(const Token& token) {
    const bool in_key = token.kind == TokenKind::kBare || token.kind == TokenKind::kString;
    if (!in_key && token.kind != TokenKind::kSpace) dots_ = 0;
    if (in_key && dots_ == 0) key_start_ = spot_;
    if (token.kind == TokenKind::kBare) dots_ += std::count(token.text.begin(), token.text.end(), '.');
    if (dots_ > kMaxDepth) return TomlProblem{key_start_, "a key of too many dotted parts", "at most 64 levels are read"};
    if (open_.size() <= kMaxDepth) return std::nullopt;
    return TomlProblem{spot_, "tables or lists nested too deeply", "at most 64 levels are read"};
  }

  std::optional<TomlProblem> misplaced(const Token& token) {
    const std::string because = std::string("expected ") + wanted();
    if (accept(token)) return std::nullopt;
    const bool line_end = token.kind == TokenKind::kNewline;
    return TomlProblem{spot_, line_end ? "the end of the line" : quoted(token.text), because};
  }

  bool accept(const Token& token) {
    switch (expect_) {
      case Expect::kLine: return accept_line(token);
      case Expect::kHeader:
        if (token.text == "[" && !std::exchange(second_bracket_, true)) return true;
        return starts_key(token) && go(Expect::kHeaderKey);
      case Expect::kHeaderKey:
        if (token.kind == TokenKind::kBare || token.kind == TokenKind::kString) return true;
        return token.text == "]" && go(Expect::kHeaderEnd);
      case Expect::kHeaderEnd:
        if (token.kind == TokenKind::kNewline) return go(Expect::kLine);
        return token.text == "]" || token.kind == TokenKind::kComment;
      case Expect::kEquals:
        if (token.kind == TokenKind::kBare || token.kind == TokenKind::kString) return true;
        return token.kind == TokenKind::kEquals && go(Expect::kValue);
      case Expect::kValue: return accept_value(token);
      case Expect::kFirstInlineKey:
        if (token.text == "}") return close(token);
        return starts_key(token) && go(Expect::kEquals);
      case Expect::kInlineKey: return starts_key(token) && go(Expect::kEquals);
      case Expect::kAfterValue: return accept_after_value(token);
    }
    return false;
  }

  bool accept_line(const Token& token) {
    if (token.kind == TokenKind::kNewline || token.kind == TokenKind::kComment) return true;
    second_bracket_ = false;
    if (token.text == "[") return go(Expect::kHeader);
    return starts_key(token) && go(Expect::kEquals);
  }

  bool accept_value(const Token& token) {
    const bool in_list = !open_.empty() && open_.back() == '[';
    if (token.kind == TokenKind::kBare || token.kind == TokenKind::kString) return go(Expect::kAfterValue);
    if (token.kind == TokenKind::kOpen) {
      open_.push_back(token.text.front());
      return go(token.text == "[" ? Expect::kValue : Expect::kFirstInlineKey);
    }
    if (token.kind == TokenKind::kNewline || token.kind == TokenKind::kComment) return in_list;
    return token.text == "]" && close(token);
  }

  bool accept_after_value(const Token& token) {
    const bool in_table = !open_.empty() && open_.back() == '{';
    switch (token.kind) {
      case TokenKind::kBare: return true;  // the time of a date
      case TokenKind::kComment: return !in_table;
      case TokenKind::kNewline: return !in_table && (!open_.empty() || go(Expect::kLine));
      case TokenKind::kComma: return !open_.empty() && go(in_table ? Expect::kInlineKey : Expect::kValue);
      case TokenKind::kClose: return close(token);
      default: return false;
    }
  }

  bool close(const Token& token) {
    if (open_.empty() || open_.back() != (token.text == "]" ? '[' : '{')) return false;
    open_.pop_back();
    return go(Expect::kAfterValue);
  }

  bool go(Expect next) {
    expect_ = next;
    return true;
  }

  void move_past(const Token& token) {
    const auto lines = static_cast<int>(std::count(token.text.begin(), token.text.end(), '\n'));
    spot_.line += lines;
    const std::string_view last_line = token.text.substr(token.text.rfind('\n') + 1);
    spot_.column = (lines > 0 ? 1 : spot_.column) + static_cast<int>(count_characters(last_line));
  }

  Spot spot_{0, 1, 1};
  Spot key_start_;
  std::ptrdiff_t dots_ = 0;
  Expect expect_ = Expect::kLine;
  bool second_bracket_ = false;
  std::vector<char> open_;
};

}  // namespace

std::optional<TomlProblem> first_toml_problem(std::string_view text) {
  Guard guard;
  while (!text.empty()) {
    const Token token = next_toml_token(text);
    if (std::optional<TomlProblem> problem = guard.look_at(token)) return problem;
    text.remove_prefix(token.text.size());
  }
  return guard.look_at_end();
}

}  // namespace pintle
