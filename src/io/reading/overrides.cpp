#include "io/reading/overrides.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text/utf8.h"
#include "io/reading/choose_law.h"
#include "io/schema/schema.h"
#include "io/text.h"

namespace pintle {
namespace {

// Moves a value's spots to its place after the equals sign of the override.
void move_spots(Node& node, int source, int shift) {
  node.spot = {source, node.spot.line, node.spot.column + shift};
  if (Array* array = std::get_if<Array>(&node.value)) {
    for (Node& item : *array) move_spots(item, source, shift);
  } else if (Table* table = node.table()) {
    Table moved;
    for (const Entry& entry : table->entries()) {
      Node value = entry.value;
      move_spots(value, source, shift);
      moved.append(entry.key, {source, entry.key_spot.line, entry.key_spot.column + shift}, std::move(value));
    }
    *table = std::move(moved);
  }
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Whether the names in a section are chosen by the model.
bool chooses_names(const std::string& section) {
  if (section == "parameters") return true;
  const std::vector<std::string> children = Schema::model().children(section);
  return std::find(children.begin(), children.end(), "*") != children.end();
}

class Override {
 public:
  Override(Document& document, int source, Complaints& complaints)
      : document_(document),
        source_(source),
        complaints_(complaints),
        text_(document.sources[static_cast<std::size_t>(source)].text) {}

  void apply() {
    const std::size_t equals = text_.find('=');
    const std::string path = text_.substr(0, equals);
    const std::vector<std::string> parts = split_path(path);
    const bool good_path = std::all_of(parts.begin(), parts.end(), [](const auto& part) { return is_bare_key(part); });
    if (equals == std::string::npos || !good_path || parts.size() > kMaxDepth) {
      complaints_.add(spot_, "", in_quotes(text_), "an override is path.to.key=value", "simulate.duration=2");
      return;
    }
    Table* table = document_.root.table();
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      table = step_into(*table, parts, i);
      if (table == nullptr) return;
      spot_.column += static_cast<int>(parts[i].size()) + 1;
    }
    const int value_column = 2 + static_cast<int>(count_characters(path));
    Node value = read_override_value(text_.substr(equals + 1), source_, value_column);
    if (Node* old = table->find(parts.back())) {
      *old = std::move(value);
    } else if (!refuse_new_name(*table, parts, parts.size() - 1)) {
      table->append(parts.back(), spot_, std::move(value));
    }
  }

 private:
  // An override changes what the file has: a new body, joint or parameter is taken for a misspelling.
  bool refuse_new_name(const Table& table, const std::vector<std::string>& parts, std::size_t i) {
    if (i != 1 || !chooses_names(parts[0])) return false;
    complain_of_unknown_name(complaints_, table, parts[0], parts[1], spot_);
    return true;
  }

  Table* step_into(Table& table, const std::vector<std::string>& parts, std::size_t i) {
    Node* node = table.find(parts[i]);
    if (node == nullptr && refuse_new_name(table, parts, i)) return nullptr;
    if (node == nullptr) {
      Node empty;
      empty.spot = spot_;
      node = &table.append(parts[i], spot_, std::move(empty));
    }
    if (node->table() == nullptr) {
      complaints_.add(spot_, parts[i], describe(*node), "this is a value and has no keys",
                      "the path up to here");
    }
    return node->table();
  }

  Document& document_;
  int source_;
  Complaints& complaints_;
  std::string text_;
  Spot spot_{source_, 1, 1};
};

constexpr std::string_view kLawOption = "--law ";

Source source_of(const std::string& override_text) {
  if (!override_text.starts_with(kLawOption)) return {"--set", override_text};
  return {"--law", override_text.substr(kLawOption.size())};
}

}  // namespace

Node read_override_value(const std::string& text, int source, int column) {
  constexpr std::string_view kKey = "x = ";
  const bool one_line = text.find_first_of("\r\n") == std::string::npos;
  if (one_line) {
    try {
      Document document = parse_toml(std::string(kKey) + text, "--set");
      const std::vector<Entry>& entries = document.root.table()->entries();
      if (entries.size() == 1 && entries.front().key == "x") {
        Node value = entries.front().value;
        move_spots(value, source, column - 1 - static_cast<int>(kKey.size()));
        return value;
      }
    } catch (const InputError&) {
      // Not TOML: it is an unquoted string.
    }
  }
  Node node;
  node.value = text;
  node.spot = {source, 1, column};
  return node;
}

void complain_of_unknown_name(Complaints& complaints, const Table& section, const std::string& section_name, const std::string& name, Spot spot) {
  std::vector<std::string> names;
  for (const Entry& entry : section.entries()) names.push_back(entry.key);
  const std::string kind = section_name == "parameters" ? "parameter" : section_name;
  complaints.add(spot, section_name + "." + name, in_quotes(name), "the model has no such " + kind, complaints.did_you_mean(name, names));
}

void apply_overrides(Document& document, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) document.sources.push_back(source_of(text));
  Complaints complaints(document);
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    if (overrides[i].size() > kMaxFileBytes || first_invalid_utf8(overrides[i])) {
      complaints.add({static_cast<int>(i) + 1, 1, 1}, "", "a byte that is not UTF-8", "overrides are UTF-8 text",
                     "plain letters");
      continue;
    }
    if (overrides[i].starts_with(kLawOption)) choose_law(document, static_cast<int>(i) + 1, complaints);
    else Override(document, static_cast<int>(i) + 1, complaints).apply();
  }
  complaints.throw_if_any();
}

}  // namespace pintle
