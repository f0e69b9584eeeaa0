#include "io/toml/toml_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "base/text/utf8.h"
#include "io/text.h"
#include "io/toml/toml_lexer.h"

namespace pintle {
namespace {

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

bool starts_key(const Token& token) {
  return token.kind == TokenKind::kString || (token.kind == TokenKind::kBare && is_key_character(token.text.front()));
}

constexpr std::string_view kCurlyQuotes = "\u201C\u201D\u201E\u2018\u2019\u201A\u00AB\u00BB";

// Whether a string has its closing quotes. The parser catches what this wrongly accepts.
bool is_closed(std::string_view string) {
  const bool block = string.starts_with("\"\"\"") || string.starts_with("'''");
  return string.size() >= (block ? 6U : 2U) && string.back() == string.front();
}

// Steps through the pieces; `expect_` says what may come next, `open_` which lists and inline tables are still open.
class Guard {
 public:
  // Why `token` is wrong here; empty if it is valid.
  std::optional<TomlProblem> look_at(const Token& token) {
    std::optional<TomlProblem> problem = wrong_character(token);
    if (!problem) problem = deep_key(token);
    if (!problem && token.kind != TokenKind::kSpace) problem = misplaced(token);
    move_past(token);
    return problem;
  }

  std::optional<TomlProblem> look_at_end() const {
    const bool complete =
        expect_ == Expect::kLine || expect_ == Expect::kHeaderEnd || (expect_ == Expect::kAfterValue && open_.empty());
    if (complete) return std::nullopt;
    return TomlProblem{spot_, "the end of the file", "expected " + wanted(), hint()};
  }

 private:
  struct Open {
    char bracket;
    int line;
  };
  enum class Expect {
    kLine,
    kHeader,
    kHeaderKey,
    kHeaderEnd,
    kEquals,
    kValue,
    kFirstInlineKey,
    kInlineKey,
    kAfterValue
  };

  std::string wanted() const {
    switch (expect_) {
      case Expect::kLine:
        return "a key or a [header]";
      case Expect::kHeader:
        return "a name in the header";
      case Expect::kHeaderKey:
        return "] after the name";
      case Expect::kHeaderEnd:
        return "the end of the line";
      case Expect::kEquals:
        return "= after the key";
      case Expect::kValue:
        return "a value";
      case Expect::kFirstInlineKey:
      case Expect::kInlineKey:
        return "a key";
      case Expect::kAfterValue:
        break;
    }
    if (open_.empty()) return "the end of the line after the value";
    const std::string begun =
        open_.back().line == spot_.line ? "" : fmt::format(" (opened on line {})", open_.back().line);
    return (in_list() ? "a comma or ] in the list" : "a comma or } in the inline table") + begun;
  }

  // What to try where wanted() is missing.
  std::string hint() const {
    switch (expect_) {
      case Expect::kHeader:
      case Expect::kHeaderKey:
        return "[body.crank]";
      case Expect::kEquals:
        return "key = value";
      case Expect::kValue:
        return "a number, \"text\", [a list] or { key = value }";
      case Expect::kAfterValue:
        break;
      default:
        return "key = value, or [header]";
    }
    if (open_.empty()) return "a new line, or quotes around the whole value";
    return in_list() ? "a comma before the next entry, or close the list with ]" : "close the table with } on the same line";
  }

  bool in_list() const { return !open_.empty() && open_.back().bracket == '['; }
  bool in_table() const { return !open_.empty() && open_.back().bracket == '{'; }

  bool in_key() const { return expect_ != Expect::kValue && expect_ != Expect::kAfterValue; }

  std::optional<TomlProblem> wrong_character(const Token& token) const {
    if (token.kind != TokenKind::kBare) return std::nullopt;
    const auto wrong = std::find_if(token.text.begin(), token.text.end(), [this](char c) {
      return !is_key_character(c) && c != '.' && (in_key() || (c != '+' && c != ':'));
    });
    if (wrong == token.text.end()) return std::nullopt;
    const auto before = static_cast<std::size_t>(wrong - token.text.begin());
    const Spot spot{0, spot_.line, spot_.column + static_cast<int>(before)};  // the text before it is ASCII
    const std::string_view found = character_at(token.text, before);
    if (in_key() && found == ":")
      return TomlProblem{spot, in_quotes(found), "a key and its value are separated by =", "key = value"};
    if (token.text.starts_with("<<<<<<<") || token.text.starts_with(">>>>>>>"))
      return TomlProblem{spot, "an unresolved merge marker", "the file contains two versions here",
                         "keep one of them"};
    if (kCurlyQuotes.find(found) != std::string_view::npos)
      return TomlProblem{spot, in_quotes(found), "strings need straight quotes",
                         "\" in place of " + std::string(found)};
    return TomlProblem{spot, in_quotes(found), "this character must be in quotes", "delete it, or \"text in quotes\""};
  }

  std::optional<TomlProblem> deep_key(const Token& token) {
    const bool in_key = token.kind == TokenKind::kBare || token.kind == TokenKind::kString;
    if (!in_key && token.kind != TokenKind::kSpace) dots_ = 0;
    if (in_key && dots_ == 0) key_start_ = spot_;
    if (token.kind == TokenKind::kBare) dots_ += std::count(token.text.begin(), token.text.end(), '.');
    if (dots_ > kMaxDepth)
      return TomlProblem{key_start_, "a key of too many dotted parts", "at most 64 levels are read", "a flatter model"};
    if (open_.size() <= kMaxDepth) return std::nullopt;
    return TomlProblem{spot_, "tables or lists nested too deeply", "at most 64 levels are read", "a flatter model"};
  }

  std::optional<TomlProblem> misplaced(const Token& token) {
    const TomlProblem problem{spot_, token.kind == TokenKind::kNewline ? "the end of the line" : in_quotes(token.text),
                              "expected " + wanted(), hint()};
    if (std::optional<TomlProblem> bare = missing_quotes(token)) return bare;
    if (!accept(token)) return problem;
    previous_ = token.text;
    return std::nullopt;
  }

  // A word, a number with a unit, or an unclosed string.
  std::optional<TomlProblem> missing_quotes(const Token& token) const {
    if (token.kind == TokenKind::kString && !is_closed(token.text))
      return TomlProblem{spot_, "a string without closing quotes",
                         "a string ends on its line, with the same quotes that opened it",
                         "close it with " + std::string(1, token.text.front())};
    if (token.kind != TokenKind::kBare || in_key()) return std::nullopt;
    const bool is_word = std::isalpha(static_cast<unsigned char>(token.text.front())) != 0;
    const bool same_line = previous_.find('\n') == std::string_view::npos && !previous_.starts_with('#');
    if (expect_ == Expect::kAfterValue && is_word && same_line)
      return TomlProblem{spot_, in_quotes(token.text), "a number with a unit needs quotes",
                         in_quotes(std::string(previous_) + " " + std::string(token.text))};
    constexpr std::array<std::string_view, 4> kWords{"true", "false", "inf", "nan"};
    const bool known = std::find(kWords.begin(), kWords.end(), token.text) != kWords.end();
    if (expect_ == Expect::kValue && is_word && !known)
      return TomlProblem{spot_, in_quotes(token.text), "text needs quotes", in_quotes(token.text)};
    return std::nullopt;
  }

  bool accept(const Token& token) {
    switch (expect_) {
      case Expect::kLine:
        return accept_line(token);
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
        if (token.kind == TokenKind::kBare || token.kind == TokenKind::kString)
          return previous_.ends_with('.') || token.text.starts_with('.');
        return token.kind == TokenKind::kEquals && go(Expect::kValue);
      case Expect::kValue:
        return accept_value(token);
      case Expect::kFirstInlineKey:
        if (token.text == "}") return close(token);
        return starts_key(token) && go(Expect::kEquals);
      case Expect::kInlineKey:
        return starts_key(token) && go(Expect::kEquals);
      case Expect::kAfterValue:
        return accept_after_value(token);
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
    if (token.kind == TokenKind::kBare || token.kind == TokenKind::kString) return go(Expect::kAfterValue);
    if (token.kind == TokenKind::kOpen) {
      open_.push_back({token.text.front(), spot_.line});
      return go(token.text == "[" ? Expect::kValue : Expect::kFirstInlineKey);
    }
    if (token.kind == TokenKind::kNewline || token.kind == TokenKind::kComment) return in_list();
    return token.text == "]" && close(token);
  }

  bool accept_after_value(const Token& token) {
    switch (token.kind) {
      case TokenKind::kBare:
        return true;  // the time part of a date
      case TokenKind::kComment:
        return !in_table();
      case TokenKind::kNewline:
        return !in_table() && (!open_.empty() || go(Expect::kLine));
      case TokenKind::kComma:
        return !open_.empty() && go(in_table() ? Expect::kInlineKey : Expect::kValue);
      case TokenKind::kClose:
        return close(token);
      default:
        return false;
    }
  }

  bool close(const Token& token) {
    if (open_.empty() || open_.back().bracket != (token.text == "]" ? '[' : '{')) return false;
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
  std::string_view previous_;  // the last piece that was neither space nor wrong
  std::vector<Open> open_;
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
