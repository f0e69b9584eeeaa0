// Converts JSON text to a document. A reader of our own, because every value must know its line and column.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/decimal.h"
#include "io/document.h"
#include "io/text.h"

namespace pintle {
namespace {

class JsonReader {
 public:
  explicit JsonReader(Document& document) : document_(document), text_(document.sources.front().text) {}

  void read_all() {
    skip_space();
    if (peek() != '{') fail("text that does not start with {", "a model is one JSON object", "{ \"format\": 1, ... }");
    document_.root = read_value("", 0);
    skip_space();
    if (at_ < text_.size())
      fail("text after the closing brace", "a model is one JSON object",
           "delete it, or look for a brace that closes too early");
    if (!complaints_.empty()) throw InputError(std::move(complaints_));
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  Spot spot() const { return {0, line_, column_}; }

  void step() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if (at_ >= text_.size() || !is_continuation_byte(text_[at_])) {
      ++column_;
    }
  }

  void step(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) step();
  }

  void skip_space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) step();
  }

  [[noreturn]] void fail(std::string found, std::string because, std::string suggestion = {}) {
    complaints_.push_back(document_.complaint(spot(), "", std::move(found), std::move(because), std::move(suggestion)));
    throw InputError(std::move(complaints_));
  }

  [[noreturn]] void fail_at_key() {
    const char c = peek();
    if (at_ >= text_.size()) fail("the end of the file", "an object is not closed", "close it with }");
    if (c == '}') fail("a comma before }", "no comma is allowed after the last entry", "delete the comma");
    if (c == '/' || c == '#') fail("a comment", "JSON has no comments", "delete it, or write the model as TOML");
    if (c == '\'') fail("a key in single quotes", "keys of a JSON object need double quotes", "\" in place of '");
    fail("a key without quotes", "keys of a JSON object are strings", "\"key\": value");
  }

  void expect(char wanted, const char* where) {
    skip_space();
    if (peek() != wanted) {
      fail(at_ < text_.size() ? in_quotes(text_.substr(at_, 1)) : "the end of the file",
           std::string("expected ") + wanted + " " + where,
           wanted == ':' ? "\"key\": value" : "look for a missing comma, bracket or brace");
    }
    step();
  }

  Node read_value(const std::string& path, int depth) {
    skip_space();
    if (depth > kMaxDepth) fail("objects or lists nested too deeply", "at most 64 levels are read", "a flatter model");
    Node node;
    node.spot = spot();
    switch (peek()) {
      case '{':
        node.value = read_object(path, depth);
        break;
      case '[':
        node.value = read_array(path, depth);
        break;
      case '"':
        node.spot.column += 1;
        node.value = read_string();
        break;
      default:
        read_word(path, node);
    }
    return node;
  }

  Table read_object(const std::string& path, int depth) {
    Table table;
    step();
    skip_space();
    if (peek() == '}') {
      step();
      return table;
    }
    while (true) {
      skip_space();
      const Spot key_spot = spot();
      if (peek() != '"') fail_at_key();
      std::string key = read_string();
      expect(':', "after a key");
      const std::string inner = path.empty() ? key : path + "." + key;
      Node value = read_value(inner, depth + 1);
      if (table.find(key) == nullptr) {
        table.append(std::move(key), key_spot, std::move(value));
      } else {
        complaints_.push_back(document_.complaint(key_spot, inner, "a second definition of the same key",
                                                  "a name may be defined only once", "rename it, or delete one"));
      }
      skip_space();
      if (peek() != ',') break;
      step();
    }
    expect('}', "or a comma after a value of an object");
    return table;
  }

  Array read_array(const std::string& path, int depth) {
    Array array;
    step();
    skip_space();
    if (peek() == ']') {
      step();
      return array;
    }
    while (true) {
      array.push_back(read_value(path, depth + 1));
      skip_space();
      if (peek() != ',') break;
      step();
    }
    expect(']', "or a comma after an entry of a list");
    return array;
  }

  std::string read_string() {
    std::string value;
    step();
    while (true) {
      const char c = peek();
      if (at_ >= text_.size() || c == '\n')
        fail("a string without closing quotes", "strings end on their line", "close it with \"");
      if (static_cast<unsigned char>(c) < 0x20U)
        fail("a control character in a string", "these must be escaped", "\\n for a line end, \\t for a tab");
      if (c == '"') break;
      if (c == '\\') {
        read_escape(value);
      } else {
        value += c;
        step();
      }
    }
    step();
    return value;
  }

  void read_escape(std::string& value) {
    constexpr std::string_view kNames = "\"\\/bfnrt";
    constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
    const char kind = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    const std::size_t index = kNames.find(kind);
    if (kind != '\0' && index != std::string_view::npos) {
      value += kMeanings[index];
      step(2);
    } else {
      append_utf8(value, read_code_point());
    }
  }

  // \uXXXX, or two of them that form a surrogate pair.
  std::uint32_t read_code_point() {
    const std::uint32_t first = read_hex_escape();
    const bool high = first >= 0xD800U && first <= 0xDBFFU;
    if (!high && (first < 0xDC00U || first > 0xDFFFU)) return first;
    const std::uint32_t second = high ? read_hex_escape() : 0;
    if (second < 0xDC00U || second > 0xDFFFU)
      fail("half a surrogate pair", "it is not a character", "the character itself");
    return 0x10000U + ((first - 0xD800U) << 10U) + (second - 0xDC00U);
  }

  std::uint32_t read_hex_escape() {
    const std::string_view rest = text_.substr(at_);
    const std::optional<std::uint32_t> value = rest.starts_with("\\u") ? hex_value(rest.substr(2, 4)) : std::nullopt;
    if (!value || rest.size() < 6)
      fail("an unknown escape", "JSON knows \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX", "\\\\ for a backslash");
    step(6);
    return *value;
  }

  void read_word(const std::string& path, Node& node) {
    const std::size_t end = std::min(text_.find_first_of(" \t\r\n,]}:\"[{", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    if (word == "true" || word == "false") {
      node.value = word == "true";
    } else if (word == "null") {
      complaints_.push_back(document_.complaint(spot(), path, "null", "empty values are not allowed",
                                                "leave the key out to use its default"));
      node.value = std::int64_t{0};
    } else if (!read_number(word, node)) {
      fail(word.empty() ? "no value" : in_quotes(word), "a JSON value is expected", "strings with units need double quotes");
    }
    if (node.real() != nullptr && !std::isfinite(*node.real())) {
      complaints_.push_back(
          document_.complaint(spot(), path, std::string(word), "numbers must be finite", "a number below 1e308"));
    }
    step(word.size());
  }

  static bool read_number(std::string_view word, Node& node) {
    const std::string_view digits = word.starts_with('-') ? word.substr(1) : word;
    if (digits.empty() || digits.front() < '0' || digits.front() > '9') return false;
    if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9') return false;
    const char* const end = word.data() + word.size();
    if (word.find_first_of(".eE") == std::string_view::npos) {
      std::int64_t integer = 0;
      const auto result = std::from_chars(word.data(), end, integer);
      if (result.ec == std::errc() && result.ptr == end) {
        node.value = integer;
        return true;
      }
    }
    const Decimal real = read_decimal(word);
    if (!real.whole) return false;
    node.value = real.value;
    return true;
  }

  Document& document_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int column_ = 1;
  std::vector<Complaint> complaints_;
};

}  // namespace

Document parse_json(std::string_view text, std::string_view file_name) {
  Document document;
  document.sources.emplace_back(std::string(file_name), std::string(text));
  JsonReader(document).read_all();
  return document;
}

}  // namespace pintle
