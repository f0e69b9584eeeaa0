// Converts TOML text to a document with toml++, which sorts keys: their order in the file is restored from their positions.

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text/utf8.h"
#include "io/document.h"
#include "io/text.h"
#include "io/toml/toml_guard.h"

namespace pintle {
namespace {

class TomlConverter {
 public:
  explicit TomlConverter(const Document& document) : document_(document) {}

  Node convert(const toml::node& node, int depth) {
    Node out;
    out.spot = spot_of(node.source());
    if (depth > kMaxDepth) {
      complain(out.spot, "tables or lists nested too deeply", "at most 64 levels are read", "a flatter model");
    } else if (const toml::table* table = node.as_table()) {
      out.value = convert_table(*table, depth);
    } else if (const toml::array* array = node.as_array()) {
      Array items;
      items.reserve(array->size());
      for (const toml::node& item : *array) items.push_back(convert(item, depth + 1));
      out.value = std::move(items);
    } else {
      convert_scalar(node, out);
    }
    return out;
  }

  std::vector<Complaint> complaints;

 private:
  static Spot spot_of(const toml::source_region& region) {
    return {0, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
  }

  Table convert_table(const toml::table& table, int depth) {
    std::vector<std::pair<Spot, toml::table::const_iterator>> order;
    order.reserve(table.size());
    for (auto it = table.begin(); it != table.end(); ++it) order.emplace_back(spot_of(it->first.source()), it);
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
      return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
    });
    Table out;
    const std::size_t length = path_.size();
    for (const auto& [spot, it] : order) {
      std::string key(it->first.str());
      if (length > 0) path_ += '.';
      path_ += key;
      out.append(std::move(key), spot, convert(it->second, depth + 1));
      path_.resize(length);
    }
    return out;
  }

  void convert_scalar(const toml::node& node, Node& out) {
    if (const auto* string = node.as_string()) {
      out.value = string->get();
      out.spot = inside_quotes(out.spot);
    } else if (const auto* integer = node.as_integer()) {
      out.value = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
      out.value = real->get();
      if (!std::isfinite(real->get()))
        complain(out.spot, number_text(out), "numbers must be finite", "a number below 1e308");
    } else if (const auto* truth = node.as_boolean()) {
      out.value = truth->get();
    } else {
      complain(out.spot, "a date or a time", "models have no dates", "write it as a string in quotes");
    }
  }

  // From the opening quote of a string to its first character.
  Spot inside_quotes(Spot spot) const {
    const Source& source = document_.sources.front();
    const std::string_view rest = std::string_view(source.text).substr(source.offset_of(spot.line, spot.column));
    if (!rest.starts_with("\"\"\"") && !rest.starts_with("'''")) return {spot.source, spot.line, spot.column + 1};
    const bool next_line = rest.substr(3).starts_with("\n") || rest.substr(3).starts_with("\r\n");
    return next_line ? Spot{spot.source, spot.line + 1, 1} : Spot{spot.source, spot.line, spot.column + 3};
  }

  void complain(Spot spot, std::string found, std::string because, std::string suggestion = {}) {
    complaints.push_back(document_.complaint(spot, path_, std::move(found), std::move(because), std::move(suggestion)));
  }

  const Document& document_;
  std::string path_;  // of the value being converted
};

// The parser names the key in quotes but points at its value: go back to the key if it is on the same line.
Spot spot_of_second(const Document& document, Spot spot, std::string_view words) {
  const std::size_t open = words.find('\'');
  const std::size_t close = words.rfind('\'');
  if (open == std::string_view::npos || close <= open + 1) return spot;
  const std::string_view key = words.substr(open + 1, close - open - 1);
  const Source& source = document.sources.front();
  const std::string_view before =
      source.line(spot.line).substr(0, source.offset_of(spot.line, spot.column) - source.offset_of(spot.line, 1));
  const std::size_t at = before.rfind(key);
  if (at == std::string_view::npos) return spot;
  return {spot.source, spot.line, 1 + static_cast<int>(count_characters(before.substr(0, at)))};
}

struct SyntaxAdvice {
  const char* part;  // of the parser's message
  const char* found;
  const char* suggestion;
};

constexpr std::array<SyntaxAdvice, 5> kSyntaxAdvice{{
    {"not representable", "a whole number with too many digits", "write it as a decimal number, such as 1e20"},
    {"floating-point", "a number that cannot be read", "a number below 1e308, such as 1.5e3"},
    {"escape", "an unknown escape", "\\\\ for a backslash, or single quotes around the text"},
    {"string", "a malformed string", "close it with the quotes that opened it; escape other quotes with \\"},
    {"", "text that is not TOML", "strings with units need quotes, keys are followed by =, lists need [ ]"},
}};

Complaint syntax_complaint(const Document& document, const toml::parse_error& error) {
  std::string_view words = error.description();
  const Spot spot{0, static_cast<int>(error.source().begin.line), static_cast<int>(error.source().begin.column)};
  if (words.find("redefine") != std::string_view::npos) {
    return document.complaint(spot_of_second(document, spot, words), "", "a second definition of the same key or table",
                              "a name may be defined only once", "rename it, or delete one of the two");
  }
  if (words.find("expected ']'") != std::string_view::npos && document.sources[0].line(spot.line).starts_with('['))
    return document.complaint(spot, "", "a name with something else in it", "a table's name stands in [ ] and has no blanks", "letters, digits, _ and - alone, such as [joint.pin_A]");
  const auto advice = std::find_if(kSyntaxAdvice.begin(), kSyntaxAdvice.end(), [&](const SyntaxAdvice& candidate) {
    return words.find(candidate.part) != std::string_view::npos;
  });
  if (const std::size_t colon = words.find(": "); words.starts_with("Error") && colon != std::string_view::npos)
    words.remove_prefix(colon + 2);
  return document.complaint(spot, "", advice->found, std::string(words), advice->suggestion);
}

Document document_of(std::string_view text, std::string_view file_name) {
  Document document;
  document.sources.emplace_back(std::string(file_name), std::string(text));
  return document;
}

Document converted(Document document, std::string_view text, std::string_view file_name) {
  try {
    const toml::table table = toml::parse(text, file_name);
    TomlConverter converter(document);
    document.root = converter.convert(table, 0);
    if (!converter.complaints.empty()) throw InputError(std::move(converter.complaints));
  } catch (const toml::parse_error& error) {
    throw InputError({syntax_complaint(document, error)});
  }
  return document;
}

}  // namespace

Document parse_toml(std::string_view text, std::string_view file_name) {
  Document document = document_of(text, file_name);
  if (const std::optional<TomlProblem> problem = first_toml_problem(text))
    throw InputError({document.complaint(problem->spot, "", problem->found, problem->because, problem->suggestion)});
  return converted(std::move(document), text, file_name);
}

Document parse_own_toml(std::string_view text, std::string_view file_name) { return converted(document_of(text, file_name), text, file_name); }

}  // namespace pintle
