#include "io/toml/edit_toml.h"

#include <utility>

#include "io/document.h"
#include "io/reading/overrides.h"
#include "io/toml/toml_lexer.h"
#include "io/writers.h"

namespace pintle {
namespace {

// A line of the file, or several if a value spans them, as offsets into the text.
struct Statement {
  std::size_t begin = 0, end = 0;              // without the line end
  std::size_t value_begin = 0, value_end = 0;  // of "key = value"; empty for anything else
  std::string key;                             // as written, or the name of a header
  bool header = false;
};

std::vector<Statement> statements_of(std::string_view text) {
  std::vector<Statement> out(1);
  int depth = 0;
  std::size_t at = 0;
  bool after_equals = false;
  for (const Token& token : cut_toml(text)) {
    Statement& s = out.back();
    const std::size_t end = at + token.text.size();
    const bool first = s.begin == s.end;
    if (token.kind == TokenKind::kNewline && depth <= 0) {
      Statement next;
      next.begin = next.end = end;
      out.push_back(std::move(next));
      after_equals = false;
      at = end;
      continue;
    }
    if (token.kind == TokenKind::kOpen) {
      if (first && !after_equals) s.header = true;
      ++depth;
    }
    const bool written = token.kind != TokenKind::kSpace && token.kind != TokenKind::kComment;
    if (after_equals && written) {
      if (s.value_begin == s.value_end) s.value_begin = at;
      s.value_end = end;
    }
    if (!after_equals && (token.kind == TokenKind::kBare || token.kind == TokenKind::kString)) s.key += token.text;
    if (token.kind == TokenKind::kEquals && depth <= 0) after_equals = true;
    if (token.kind == TokenKind::kClose) --depth;
    if (token.kind != TokenKind::kSpace || !first) s.end = end;
    at = end;
  }
  return out;
}

std::string joined(const std::vector<std::string>& path, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ".") + path[i];
  return text;
}

[[noreturn]] void refuse(std::string_view text, std::string_view file_name, const std::vector<std::string>& path) {
  const Document document = parse_document(std::string(text), std::string(file_name));
  throw InputError({document.complaint({0, 1, 1}, joined(path, path.size()), "a table without a header of its own",
                                       "a value can be added only below its table's header", "[" + joined(path, path.size() - 1) + "] on a line of its own")});
}

std::string in_toml(std::string_view text, std::string_view file_name, const std::vector<std::string>& path, const std::string& value) {
  const std::string table = joined(path, path.size() - 1), whole = joined(path, path.size());
  std::string section;
  std::size_t insert_at = std::string::npos;
  for (const Statement& s : statements_of(text)) {
    if (s.header) section = s.key;
    const bool is_value = s.value_end > s.value_begin;
    if (is_value && (section.empty() ? s.key : section + "." + s.key) == whole)
      return std::string(text.substr(0, s.value_begin)) + value + std::string(text.substr(s.value_end));
    if (section == table && (s.header || is_value)) insert_at = s.end;
  }
  if (insert_at == std::string::npos) refuse(text, file_name, path);
  return std::string(text.substr(0, insert_at)) + "\n" + path.back() + " = " + value + std::string(text.substr(insert_at));
}

}  // namespace

std::string with_value(std::string_view text, std::string_view file_name, const std::vector<std::string>& path, const std::string& toml_value) {
  if (!file_name.ends_with(".json")) return in_toml(text, file_name, path, toml_value);
  Document document = parse_document(std::string(text), std::string(file_name));
  apply_overrides(document, {joined(path, path.size()) + "=" + toml_value});
  return to_json(document);
}

}  // namespace pintle
