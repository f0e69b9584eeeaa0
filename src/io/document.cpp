#include "io/document.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/text/utf8.h"
#include "io/text.h"

namespace pintle {
namespace {

constexpr std::size_t kSmall = 8;          // tables up to this size are searched linearly
constexpr std::size_t kLongestLine = 300;  // longer lines are not quoted in complaints [bytes]

bool is_json(std::string_view text, std::string_view file_name) {
  if (file_name.ends_with(".json")) return true;
  if (file_name.ends_with(".toml")) return false;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

Complaint whole_file_complaint(std::string_view file_name, std::string found, std::string because,
                               std::string suggestion) {
  Complaint complaint;
  complaint.place = {std::string(file_name), 1, 1};
  complaint.found = std::move(found);
  complaint.because = std::move(because);
  complaint.suggestion = std::move(suggestion);
  return complaint;
}

// Steps through the source of a string, byte by byte of its value.
class StringWalk {
 public:
  StringWalk(std::string_view raw, std::size_t start, Spot spot) : raw_(raw), at_(start), spot_(spot) {
    escapes_ = start > 0 && raw[start - 1] != '\'' && !starts_literal_block();
  }

  Spot after(std::size_t bytes) {
    while (bytes > 0 && at_ < raw_.size()) {
      const std::size_t produced = escapes_ && raw_[at_] == '\\' ? skip_escape() : skip_plain();
      bytes -= std::min(produced, bytes);
    }
    return spot_;
  }

 private:
  // The text of a ''' block starts on the line after the quotes.
  bool starts_literal_block() const {
    std::size_t back = at_;
    while (back > 0 && (raw_[back - 1] == '\n' || raw_[back - 1] == '\r')) --back;
    return back > 0 && raw_[back - 1] == '\'';
  }

  void step() {
    const char c = raw_[at_++];
    if (c == '\n') {
      ++spot_.line;
      spot_.column = 1;
    } else if (at_ >= raw_.size() || !is_continuation_byte(raw_[at_])) {
      ++spot_.column;
    }
  }

  std::size_t skip_plain() {
    step();
    return 1;
  }

  // Returns how many bytes of the value the escape stands for.
  std::size_t skip_escape() {
    step();
    if (at_ >= raw_.size()) return 0;
    const char kind = raw_[at_];
    if (kind == '\n' || kind == '\r' || kind == ' ' || kind == '\t') {
      while (at_ < raw_.size() && std::string_view(" \t\r\n").find(raw_[at_]) != std::string_view::npos) step();
      return 0;
    }
    step();
    if (kind != 'u' && kind != 'U') return 1;
    const std::size_t digits = kind == 'u' ? 4 : 8;
    const std::size_t bytes = utf8_length_of_hex(raw_.substr(at_, digits));
    for (std::size_t i = 0; i < digits && at_ < raw_.size(); ++i) step();
    return bytes;
  }

  std::string_view raw_;
  std::size_t at_;
  Spot spot_;
  bool escapes_ = true;
};

bool same_tables(const Table& a, const Table& b) {
  if (a.entries().size() != b.entries().size()) return false;
  return std::all_of(a.entries().begin(), a.entries().end(), [&](const Entry& entry) {
    const Node* other = b.find(entry.key);
    return other != nullptr && same_tree(entry.value, *other);
  });
}

}  // namespace

const Entry* Table::find_entry(std::string_view key) const {
  if (entries_.size() <= kSmall) {
    const auto it = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.key == key; });
    return it == entries_.end() ? nullptr : &*it;
  }
  const auto it = index_.find(key);
  return it == index_.end() ? nullptr : &entries_[it->second];
}

const Node* Table::find(std::string_view key) const {
  const Entry* entry = find_entry(key);
  return entry == nullptr ? nullptr : &entry->value;
}

Node* Table::find(std::string_view key) {
  return const_cast<Node*>(std::as_const(*this).find(key));
}

Node& Table::append(std::string key, Spot key_spot, Node value) {
  entries_.push_back({std::move(key), key_spot, std::move(value)});
  if (entries_.size() == kSmall + 1) {
    for (std::size_t i = 0; i < entries_.size(); ++i) index_.emplace(entries_[i].key, i);
  } else if (entries_.size() > kSmall) {
    index_.emplace(entries_.back().key, entries_.size() - 1);
  }
  return entries_.back().value;
}

Source::Source(std::string source_name, std::string source_text)
    : name(std::move(source_name)), text(std::move(source_text)), line_starts{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts.push_back(i + 1);
  }
}

std::string_view Source::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_starts.size()) return {};
  const std::size_t start = line_starts[static_cast<std::size_t>(number) - 1];
  std::string_view rest = std::string_view(text).substr(start);
  rest = rest.substr(0, rest.find('\n'));
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  return rest;
}

std::size_t Source::offset_of(int number, int column) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_starts.size()) return text.size();
  std::size_t at = line_starts[static_cast<std::size_t>(number) - 1];
  for (int i = 1; i < column && at < text.size(); ++i) {
    ++at;
    while (at < text.size() && is_continuation_byte(text[at])) ++at;
  }
  return at;
}

Place Document::place(Spot spot) const {
  return {sources[static_cast<std::size_t>(spot.source)].name, spot.line, spot.column};
}

Spot Document::inside(const Node& string, std::size_t offset) const {
  const Source& source = sources[static_cast<std::size_t>(string.spot.source)];
  return StringWalk(source.text, source.offset_of(string.spot.line, string.spot.column), string.spot).after(offset);
}

Complaint Document::complaint(Spot spot, std::string path, std::string found, std::string because,
                              std::string suggestion) const {
  const std::string_view line = sources[static_cast<std::size_t>(spot.source)].line(spot.line);
  return {place(spot),        std::move(path),       std::move(found),
          std::move(because), std::move(suggestion), line.size() > kLongestLine ? std::string() : std::string(line)};
}

void check_text(std::string_view text, std::string_view file_name) {
  if (text.size() > kMaxFileBytes) {
    throw InputError({whole_file_complaint(file_name, std::to_string(text.size()) + " bytes",
                                           "model files may have at most 64 MB", "is this a model file?")});
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw InputError({whole_file_complaint(file_name, "an empty file", "a model needs at least `format = 1`",
                                           "start from a file of the folder mechanisms/")});
  }
  if (const std::optional<std::size_t> bad = first_invalid_utf8(text)) {
    const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    Complaint complaint = whole_file_complaint(file_name, is_utf16 ? "UTF-16 text" : "a byte that is not UTF-8",
                                               "model files are UTF-8 text", "save the file as UTF-8");
    const std::string_view before = text.substr(0, *bad);
    complaint.place.line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 == 0
    complaint.place.column = 1 + static_cast<int>(count_characters(before.substr(line_start)));
    throw InputError({complaint});
  }
}

Document parse_document(std::string_view text, std::string_view file_name) {
  check_text(text, file_name);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return is_json(text, file_name) ? parse_json(text, file_name) : parse_toml(text, file_name);
}

bool same_tree(const Node& a, const Node& b) {
  if (a.value.index() != b.value.index()) return false;
  if (const Table* table = a.table()) return same_tables(*table, *b.table());
  if (const Array* array = a.array()) {
    return std::equal(array->begin(), array->end(), b.array()->begin(), b.array()->end(), same_tree);
  }
  if (const double* real = a.real()) return *real == *b.real() || (std::isnan(*real) && std::isnan(*b.real()));
  if (const std::string* string = a.string()) return *string == *b.string();
  if (const std::int64_t* integer = a.integer()) return *integer == *b.integer();
  return *a.truth() == *b.truth();
}

std::string describe(const Node& node) {
  if (node.table() != nullptr) return "a table";
  if (const Array* array = node.array()) {
    return "a list of " + std::to_string(array->size()) + (array->size() == 1 ? " entry" : " entries");
  }
  if (const std::string* string = node.string()) return in_quotes(*string);
  if (const bool* truth = node.truth()) return *truth ? "true" : "false";
  return number_text(node);
}

}  // namespace pintle
