// A document as TOML: sections for the first two levels of tables, dotted keys and inline tables below.

#include <algorithm>

#include "io/text.h"
#include "io/writers.h"

namespace pintle {
namespace {

constexpr int kSectionLevels = 2;  // [body.crank] is a section, its markers are dotted keys

std::string key_text(const std::string& key) {
  return is_bare_key(key) ? key : quoted_exactly(key);
}

bool holds_structure(const Table& table) {
  return std::any_of(table.entries().begin(), table.entries().end(), [](const Entry& entry) {
    return entry.value.table() != nullptr || entry.value.array() != nullptr;
  });
}

// Several lines as a block string, unless line ends or quotes in it need special care.
std::string string_text(const std::string& string) {
  const auto awkward = [](char c) {
    return (static_cast<unsigned char>(c) < 0x20U && c != '\n' && c != '\t') || c == 0x7F || c == '"' || c == '\\';
  };
  const bool block = string.find('\n') != std::string::npos && std::none_of(string.begin(), string.end(), awkward);
  return block ? "\"\"\"\n" + string + "\"\"\"" : quoted_exactly(string);
}

class TomlWriter {
 public:
  void write_section(const Table& table, const std::string& path, int level) {
    const auto is_section = [&](const Entry& entry) {
      return entry.value.table() != nullptr && level < kSectionLevels;
    };
    const bool has_lines = !std::all_of(table.entries().begin(), table.entries().end(), is_section);
    if (level > 0 && (has_lines || table.empty())) {
      text += (text.empty() ? "[" : "\n[") + path + "]\n";
    }
    for (const Entry& entry : table.entries()) {
      if (!is_section(entry)) write_line(entry);
    }
    for (const Entry& entry : table.entries()) {
      if (!is_section(entry)) continue;
      const std::string key = key_text(entry.key);
      write_section(*entry.value.table(), path.empty() ? key : path + "." + key, level + 1);
    }
  }

  std::string text;

 private:
  void write_line(const Entry& entry) {
    const Table* table = entry.value.table();
    if (table == nullptr || !holds_structure(*table)) {
      text += key_text(entry.key) + " = " + inline_text(entry.value) + '\n';
      return;
    }
    for (const Entry& inner : table->entries()) {
      text += key_text(entry.key) + "." + key_text(inner.key) + " = " + inline_text(inner.value) + '\n';
    }
  }

  std::string inline_text(const Node& node) {
    if (const Table* table = node.table()) return inline_table(*table);
    if (const Array* array = node.array()) return inline_array(*array);
    if (const std::string* string = node.string()) return string_text(*string);
    if (const bool* truth = node.truth()) return *truth ? "true" : "false";
    return number_text(node);
  }

  std::string inline_table(const Table& table) {
    if (table.empty()) return "{}";
    std::string out = "{ ";
    for (const Entry& entry : table.entries()) {
      if (out.size() > 2) out += ", ";
      const std::string* string = entry.value.string();
      out += key_text(entry.key) + " = " + (string != nullptr ? quoted_exactly(*string) : inline_text(entry.value));
    }
    return out + " }";
  }

  std::string inline_array(const Array& array) {
    std::string out = "[";
    for (const Node& item : array) {
      if (out.size() > 1) out += ", ";
      out += inline_text(item);
    }
    return out + "]";
  }
};

}  // namespace

std::string to_toml(const Document& document) {
  TomlWriter writer;
  writer.write_section(*document.root.table(), "", 0);
  return writer.text;
}

}  // namespace pintle
