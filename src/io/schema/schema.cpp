#include "io/schema/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/units.h"
#include "joints/catalog.h"
#include "laws/catalog.h"

namespace pintle {

extern const char* const kModelToml;  // schema/model.schema.toml

namespace {

constexpr std::array<std::pair<std::string_view, ValueType>, 16> kTypes{{
    {"integer", ValueType::kInteger},
    {"text", ValueType::kText},
    {"word", ValueType::kWord},
    {"words", ValueType::kWords},
    {"number", ValueType::kNumber},
    {"quantity", ValueType::kQuantity},
    {"quantities", ValueType::kQuantities},
    {"expression", ValueType::kExpression},
    {"expressions", ValueType::kExpressions},
    {"truth", ValueType::kTruth},
    {"marker", ValueType::kMarker},
    {"marker_name", ValueType::kMarkerName},
    {"marker_names", ValueType::kMarkerNames},
    {"joint_name", ValueType::kJointName},
    {"table_name", ValueType::kTableName},
    {"column", ValueType::kColumn},
}};

[[noreturn]] void schema_fault(const std::string& what) {
  throw std::logic_error("model.schema.toml: " + what);
}

std::string text_of(const Table& table, std::string_view key) {
  const Node* node = table.find(key);
  return node == nullptr ? std::string() : node->string() != nullptr ? *node->string() : std::string();
}

std::optional<double> number_of(const Table& table, std::string_view key) {
  const Node* node = table.find(key);
  if (node == nullptr) return std::nullopt;
  return node->real() != nullptr ? *node->real() : static_cast<double>(*node->integer());
}

std::vector<std::string> words_of_catalog(std::string_view catalog) {
  std::vector<std::string> words;
  const auto list = [&words](LawRole role) {
    for (const LawInfo& law : law_catalog())
      if (law.role == role) words.emplace_back(law.word);
  };
  const auto list_optional = [&](LawRole role) {
    list(role);
    words.emplace_back("none");
  };
  if (catalog == "laws") {
    list(LawRole::kHolds);
  } else if (catalog == "friction laws") {
    list_optional(LawRole::kFriction);
  } else if (catalog == "stop laws") {
    list_optional(LawRole::kStops);
  } else if (catalog == "detent laws") {
    list_optional(LawRole::kDetent);
  } else if (catalog == "joint types") {
    for (const JointTypeInfo& type : joint_type_catalog()) words.emplace_back(type.word);
  } else {
    schema_fault("unknown catalog " + std::string(catalog));
  }
  return words;
}

std::vector<std::string> words_of(const Table& table, std::string_view key) {
  const Node* node = table.find(key);
  if (node == nullptr) return {};
  if (node->string() != nullptr) return words_of_catalog(*node->string());
  std::vector<std::string> words;
  for (const Node& item : *node->array()) words.push_back(*item.string());
  return words;
}

Dimension dimension_of(const std::string& unit) {
  if (unit == "any") return kBareNumber;
  const std::optional<Unit> parsed = parse_unit(unit);
  if (!parsed) schema_fault("unit " + unit);
  return parsed->dimension;
}

KeySpec read_key(const std::string& key, const Table& table) {
  KeySpec spec;
  spec.key = key;
  spec.type_word = text_of(table, "type");
  const auto type =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& entry) { return entry.first == spec.type_word; });
  if (type == kTypes.end()) schema_fault("type of key " + key);
  spec.type = type->second;
  spec.unit = text_of(table, "unit");
  spec.dimension = dimension_of(spec.unit);
  spec.meaning = text_of(table, "meaning");
  spec.otherwise = text_of(table, "otherwise");
  if (const Node* fallback = table.find("default")) spec.fallback = *fallback;
  spec.minimum_exclusive = table.find("above") != nullptr;
  spec.minimum = number_of(table, spec.minimum_exclusive ? "above" : "minimum");
  spec.maximum = number_of(table, "maximum");
  spec.required = table.find("required") != nullptr;
  spec.count = static_cast<std::size_t>(number_of(table, "count").value_or(0));
  spec.words = words_of(table, "words");
  for (const auto& [name, words] : {std::pair("synonyms", &spec.synonyms), std::pair("meant", &spec.meant)})
    if (const Node* pairs = table.find(name))
      for (const Entry& entry : pairs->table()->entries()) words->emplace_back(entry.key, *entry.value.string());
  spec.variables = words_of(table, "of");
  return spec;
}

// The word in a line `key = "word"` of the schema; "" if there is no such line.
std::string stated_word(std::string_view text, std::string_view key) {
  const std::string line = fmt::format("\n{} = \"", key);
  const std::size_t at = text.find(line);
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + line.size();
  return std::string(text.substr(begin, text.find('"', begin) - begin));
}

TableSpec read_table(const Table& table) {
  TableSpec spec;
  spec.path = text_of(table, "path");
  spec.when = text_of(table, "when");
  spec.called = text_of(table, "called");
  spec.meaning = text_of(table, "meaning");
  if (const Node* keys = table.find("keys")) {
    for (const Entry& entry : keys->table()->entries()) spec.keys.push_back(read_key(entry.key, *entry.value.table()));
  }
  if (const Node* entries = table.find("entries")) spec.entries = read_key("*", *entries->table());
  if (const Node* catalogs = table.find("keys_from")) {
    for (const Node& catalog : *catalogs->array()) {
      (*catalog.string() == "laws" ? spec.law_keys : spec.joint_type_keys) = true;
    }
  }
  return spec;
}

// Laws may allow different ranges of one key; each law checks its own when it takes the value.
void widen(KeySpec& key, const KeySpec& other) {
  if (!key.minimum) return;
  if (!other.minimum || *other.minimum < *key.minimum) {
    key.minimum = other.minimum;
    key.minimum_exclusive = other.minimum_exclusive;
  } else if (*other.minimum == *key.minimum) {
    key.minimum_exclusive = key.minimum_exclusive && other.minimum_exclusive;
  }
}

void add_law_keys(TableSpec& table, const JointTypeInfo* type, const std::array<std::string_view, 4>& words) {
  const bool all = words.front().empty();
  for (const LawInfo& info : law_catalog()) {
    if (!all && std::find(words.begin(), words.end(), info.word) == words.end()) continue;
    for (const KeyInfo& key : info.keys) {
      const auto known = std::find_if(table.keys.begin(), table.keys.end(), [&key](const KeySpec& spec) { return spec.key == key.key; });
      if (known != table.keys.end()) {
        if (all) widen(*known, spec_of(key, type));
        continue;
      }
      table.keys.push_back(spec_of(key, type));
      if (all) table.keys.back().required = false;  // since it belongs to one law only
    }
  }
}

}  // namespace

KeySpec spec_of(const KeyInfo& info, const JointTypeInfo* type) {
  KeySpec spec;
  spec.key = info.key;
  spec.type = info.list ? ValueType::kQuantities : ValueType::kQuantity;
  spec.type_word = info.list ? "quantities" : info.unit.empty() ? "number" : "quantity";
  spec.unit = info.unit;
  if (!info.angular_unit.empty() && type != nullptr && !type->free.empty() && type->free.front().angular) spec.unit = info.angular_unit;
  spec.dimension = dimension_of(spec.unit);
  if (!info.angular_unit.empty() && type == nullptr) {
    spec.unit += " or " + std::string(info.angular_unit);
    spec.dimension = kBareNumber;
  }
  spec.meaning = info.meaning;
  spec.otherwise = info.otherwise;
  if (info.of_time) spec.variables = {"t"};
  spec.variables.insert(spec.variables.end(), info.also_of.begin(), info.also_of.end());
  if (std::isfinite(info.minimum)) spec.minimum = info.minimum;
  spec.minimum_exclusive = info.minimum_exclusive;
  spec.required = info.required;
  spec.per_component = info.per_component;
  if (!info.words.empty()) {
    spec.type = ValueType::kWord;
    spec.type_word = "word";
    spec.words.assign(info.words.begin(), info.words.end());
    spec.minimum.reset();
  }
  if (!info.required && info.otherwise.empty()) {
    spec.fallback = Node{};
    if (info.words.empty()) spec.fallback->value = info.fallback;
    else spec.fallback->value = spec.words.at(static_cast<std::size_t>(info.fallback));
  }
  if (!info.points.empty()) {
    spec.type = ValueType::kTableName;
    spec.type_word = "table_name";
    spec.minimum.reset();
    spec.fallback.reset();
    spec.otherwise = fmt::format("{}", fmt::join(info.points, " and "));
  }
  return spec;
}

const KeySpec* TableSpec::find(std::string_view key) const {
  const auto it = std::find_if(keys.begin(), keys.end(), [&](const KeySpec& spec) { return spec.key == key; });
  return it == keys.end() ? nullptr : &*it;
}

// Each "[[table]]" begins a new table.
Schema::Schema(std::string_view text) {
  constexpr std::string_view kBegin = "\n[[table]]\n";
  for (std::size_t at = text.find(kBegin), next; at != std::string_view::npos; at = next) {
    next = text.find(kBegin, at + kBegin.size());
    LazyTable& table = tables_.emplace_back();
    table.text = text.substr(at, next == std::string_view::npos ? next : next - at);
    table.path = stated_word(table.text, "path");
    table.when = stated_word(table.text, "when");
  }
}

const TableSpec& Schema::LazyTable::spec() const {
  std::call_once(once, [this] {
    const Document document = parse_own_toml(text, "model.schema.toml");
    const auto& tables = *document.root.table()->find("table")->array();
    read = read_table(*tables.front().table());
    if (tables.size() != 1 || read.path != path || read.when != when) schema_fault("[[table]], path and when stand on lines of their own, in table " + read.path);
  });
  return read;
}

std::vector<TableSpec> Schema::tables() const {
  std::vector<TableSpec> all;
  for (const LazyTable& table : tables_) all.push_back(table.spec());
  return all;
}

const Schema& Schema::model() {
  static const Schema schema{std::string_view(kModelToml)};
  return schema;
}

TableSpec Schema::assemble(std::string_view path, std::string_view when, std::string_view law, std::string_view friction, std::string_view stops,
                           std::string_view detent) const {
  TableSpec out;
  bool found = false;
  for (const LazyTable& stated : tables_) {
    if (stated.path != path || (!stated.when.empty() && stated.when != when)) continue;
    const TableSpec& table = stated.spec();
    if (!found) out = table;
    if (found) out.keys.insert(out.keys.end(), table.keys.begin(), table.keys.end());
    found = true;
  }
  if (!found) schema_fault("no table " + std::string(path));
  out.children = children(path);
  if (const JointTypeInfo* type = out.joint_type_keys ? find_joint_type(when) : nullptr) {
    for (const KeyInfo& key : type->keys) {
      out.keys.push_back(spec_of(key));
      // A geometry that may be left out is measured during assembly, so it has no default value.
      out.keys.back().fallback.reset();
      if (!key.required && key.otherwise.empty()) out.keys.back().otherwise = "as assembled";
    }
  }
  if (out.law_keys) add_law_keys(out, find_joint_type(when), {law, friction, stops, detent});
  return out;
}

std::vector<std::string> Schema::children(std::string_view path) const {
  std::vector<std::string> keys;
  const std::string prefix = path.empty() ? std::string() : std::string(path) + ".";
  for (const LazyTable& table : tables_) {
    if (table.path.size() <= prefix.size() || !std::string_view(table.path).starts_with(prefix)) continue;
    const std::string rest = table.path.substr(prefix.size());
    std::string key = rest.substr(0, rest.find('.'));
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(std::move(key));
  }
  return keys;
}

std::vector<std::string> Schema::kinds_with(std::string_view path, std::string_view key) const {
  std::vector<std::string> kinds;
  for (const LazyTable& stated : tables_) {
    if (stated.path != path) continue;
    const TableSpec& table = stated.spec();
    if (!table.when.empty() && table.find(key) != nullptr) kinds.push_back(table.called);
    if (!table.joint_type_keys) continue;
    for (const JointTypeInfo& type : joint_type_catalog())
      if (find_key(type.keys, key)) kinds.push_back(std::string(type.word) + " joints");
  }
  return kinds;
}

std::vector<std::string> Schema::tables_with(std::string_view key) const {
  std::vector<std::string> paths;
  for (const LazyTable& table : tables_)
    if (table.spec().find(key) != nullptr && std::find(paths.begin(), paths.end(), table.path) == paths.end()) paths.push_back(table.path);
  return paths;
}

}  // namespace pintle
