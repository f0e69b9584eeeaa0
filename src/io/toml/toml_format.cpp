// Tidies TOML: pieces of text are moved, never rewritten.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/text/utf8.h"
#include "io/toml/toml_lexer.h"
#include "io/writers.h"

namespace pintle {
namespace {

using Tokens = std::vector<Token>;

enum class LineKind { kBlank, kComment, kHeader, kValue };

// A line of the result (several, if a list or a string spans them).
struct Line {
  LineKind kind = LineKind::kBlank;
  std::string text;
  std::string comment;
};

bool is_space(const Token& token) {
  return token.kind == TokenKind::kSpace;
}

int depth_change(const Token& token) {
  return token.kind == TokenKind::kOpen ? 1 : token.kind == TokenKind::kClose ? -1 : 0;
}

std::string without_trailing_space(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of(" \t") + 1));
}

// Splits at line ends that are not inside brackets. (Line ends inside strings belong to a string piece.)
std::vector<Tokens> split_statements(const Tokens& tokens) {
  std::vector<Tokens> statements(1);
  int depth = 0;
  for (const Token& token : tokens) {
    depth += depth_change(token);
    if (token.kind == TokenKind::kNewline && depth <= 0) {
      statements.emplace_back();
    } else {
      statements.back().push_back(token);
    }
  }
  return statements;
}

// A value, with one space after commas and inside braces; a list over several lines keeps its lines.
class ValueText {
 public:
  std::string text;

  void add(const Token& token) {
    switch (token.kind) {
      case TokenKind::kSpace:
        return;
      case TokenKind::kNewline:
        newlines_ = std::min(newlines_ + 1, 2);
        return;
      case TokenKind::kComment:
        add_comment(token);
        return;
      default:
        break;
    }
    const bool closes = token.kind == TokenKind::kClose;
    if (closes) --depth_;
    if (!break_line(closes)) add_blank(token);
    if (token.kind == TokenKind::kOpen) ++depth_;
    text += token.text;
    last_ = token;
  }

 private:
  bool break_line(bool closes) {
    if (newlines_ == 0) return false;
    text.append(static_cast<std::size_t>(closes ? 1 : newlines_), '\n');
    text.append(static_cast<std::size_t>(2 * std::max(depth_, 0)), ' ');
    newlines_ = 0;
    return true;
  }

  void add_comment(const Token& token) {
    if (!break_line(false)) text += "  ";
    text += without_trailing_space(token.text);
    last_ = token;
  }

  void add_blank(const Token& token) {
    const bool brace = token.text == "}" || last_.text == "{";
    const bool empty_braces = token.text == "}" && last_.text == "{";
    const bool after_comma = last_.kind == TokenKind::kComma && token.kind != TokenKind::kClose;
    const bool around_equals = token.kind == TokenKind::kEquals || last_.kind == TokenKind::kEquals;
    const bool words = last_.kind == TokenKind::kBare && token.kind == TokenKind::kBare && !in_dotted(token);
    if ((brace && !empty_braces) || after_comma || around_equals || words) text += ' ';
  }

  // A dotted key loses the spaces around its dots; a date with a space inside keeps it.
  bool in_dotted(const Token& token) const { return last_.text.ends_with('.') || token.text.starts_with('.'); }

  Token last_{TokenKind::kNewline, {}};
  int depth_ = 0;
  int newlines_ = 0;
};

Line read_line(Tokens tokens) {
  while (!tokens.empty() && is_space(tokens.back())) tokens.pop_back();
  while (!tokens.empty() && is_space(tokens.front())) tokens.erase(tokens.begin());
  Line line;
  if (tokens.empty()) return line;
  if (tokens.back().kind == TokenKind::kComment) {
    line.comment = without_trailing_space(tokens.back().text);
    tokens.pop_back();
  }
  line.kind = tokens.empty() ? LineKind::kComment : LineKind::kValue;
  if (tokens.empty()) return line;
  if (tokens.front().kind == TokenKind::kOpen) line.kind = LineKind::kHeader;
  ValueText value;
  for (const Token& token : tokens) value.add(token);
  line.text = std::move(value.text);
  return line;
}

// Aligns the comments of values on consecutive lines.
void align_comments(std::vector<Line>& lines) {
  const auto alignable = [](const Line& line) {
    return line.kind == LineKind::kValue && line.text.find('\n') == std::string::npos;
  };
  constexpr std::size_t kWidest = 60;  // a longer line does not shift the comments of the others
  for (std::size_t first = 0; first < lines.size();) {
    std::size_t end = first;
    std::size_t width = 0;
    for (; end < lines.size() && alignable(lines[end]); ++end) {
      const std::size_t length = count_characters(lines[end].text);
      if (!lines[end].comment.empty() && length <= kWidest) width = std::max(width, length);
    }
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t length = count_characters(lines[i].text);
      if (!lines[i].comment.empty() && length < width) lines[i].text.append(width - length, ' ');
    }
    first = std::max(end, first + 1);
  }
}

// At most one blank line, and one before each header and the comments directly above it.
std::vector<Line> space_lines(const std::vector<Line>& lines) {
  std::vector<Line> spaced;
  for (const Line& line : lines) {
    if (line.kind == LineKind::kBlank && (spaced.empty() || spaced.back().kind == LineKind::kBlank)) continue;
    if (line.kind == LineKind::kHeader) {
      auto at = spaced.end();
      while (at != spaced.begin() && std::prev(at)->kind == LineKind::kComment) --at;
      if (at != spaced.begin() && std::prev(at)->kind != LineKind::kBlank) spaced.insert(at, Line{});
    }
    spaced.push_back(line);
  }
  while (!spaced.empty() && spaced.back().kind == LineKind::kBlank) spaced.pop_back();
  return spaced;
}

std::string join(const std::vector<Line>& lines) {
  std::string text;
  for (const Line& line : lines) {
    text += line.text;
    if (!line.comment.empty()) text += (line.text.empty() ? "" : "  ") + line.comment;
    text += '\n';
  }
  return text;
}

}  // namespace

std::string format_toml(std::string_view text, std::string_view file_name) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  check_text(text, file_name);
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const Document before = parse_toml(text, file_name);
  std::vector<Line> lines;
  for (const Tokens& statement : split_statements(cut_toml(text))) lines.push_back(read_line(statement));
  lines = space_lines(lines);
  align_comments(lines);
  std::string formatted = join(lines);
  if (!same_tree(before.root, parse_toml(formatted, file_name).root)) {
    throw std::logic_error("formatting " + std::string(file_name) + " would have changed its meaning");
  }
  return formatted;
}

}  // namespace pintle
