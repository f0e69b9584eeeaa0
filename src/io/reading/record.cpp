#include "io/reading/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/reading/law_keys.h"
#include "io/text.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

// An example of how a required key is stated.
std::string example_line(const KeySpec& key) {
  const std::string start = key.key + " = ";
  const std::string number = key.unit.empty() || key.unit == "any" ? "1" : key.unit == "m" ? "\"10 mm\"" : "\"1 " + key.unit + "\"";
  switch (key.type) {
    case ValueType::kWord:
      return start + in_quotes(key.words.empty() ? "word" : key.words.front());
    case ValueType::kMarkerName:
      return start + "\"crank.A\"";
    case ValueType::kMarkerNames:
      return start + "[\"ground.A\", \"crank.A\"]";
    case ValueType::kTableName:
      return start + "\"curve\", the name of a table";
    case ValueType::kJointName:
      return start + "\"O2\", the name of a joint";
    case ValueType::kQuantities:
      return start + "[" + number + ", " + number + "]";
    default:
      return start + number;
  }
}

// The laws that have this key, in the form a joint states them: stops = "hard" or stops = "cushioned".
std::string laws_with(std::string_view key) {
  std::string list;
  for (const LawInfo& law : law_catalog())
    if (has_key(&law, key))
      list += (list.empty() ? "" : " or ") + std::string(key_of(law.role)) + " = " + in_quotes(std::string(law.word));
  return list;
}

// The right place of a key that is stated in the wrong table; "" if it has none or more than a few.
std::string home_of(std::string_view key) {
  constexpr std::size_t kFew = 3;
  const std::vector<std::string> paths = Schema::model().tables_with(key);
  if (paths.empty() || paths.size() > kFew) return {};
  std::string list;
  for (std::string path : paths) {
    if (const std::size_t star = path.find('*'); star != std::string::npos) path.replace(star, 1, "NAME");
    list += (list.empty() ? "" : " or ") + (path.empty() ? std::string("at the top of the file, above every table") : "in [" + path + "]");
  }
  return "state it " + list + ", or ";
}

// Whether the model has a parameter of this name, which is set as parameters.NAME.
bool is_parameter(const Table& model, std::string_view key) {
  const Node* parameters = model.find("parameters");
  return parameters != nullptr && parameters->table() != nullptr && parameters->table()->find(key) != nullptr;
}

// What is stated instead of a law with this key: "none", which switches the law off in one word, or another law of its role: law = "linear" written
// over law = "clearance" shows the pin ideal. The keys wait until their law is stated again. "" if neither is stated.
std::string stated_instead(const Table& table, std::string_view key) {
  std::string instead;
  for (const LawInfo& law : law_catalog()) {
    const Node* chosen = table.find(key_of(law.role));
    if (!has_key(&law, key) || chosen == nullptr || chosen->string() == nullptr) continue;
    if (*chosen->string() == "none") return "none";
    if (find_law(*chosen->string()) != nullptr) instead = *chosen->string();
  }
  return instead;
}

}  // namespace

const Value* Record::find(std::string_view key) const {
  const auto it = values.find(key);
  return it == values.end() ? nullptr : &it->second;
}

bool Record::states(std::string_view key) const {
  const Value* value = find(key);
  return value != nullptr && value->node != nullptr;
}

std::optional<double> Record::maybe_number(std::string_view key) const {
  const Value* value = find(key);
  if (value == nullptr || value->numbers.empty()) return std::nullopt;
  return value->numbers.front();
}

double Record::number(std::string_view key, double otherwise) const {
  return maybe_number(key).value_or(otherwise);
}

std::optional<Vec2> Record::maybe_pair(std::string_view key) const {
  const Value* value = find(key);
  if (value == nullptr || value->numbers.size() != 2) return std::nullopt;
  return Vec2{value->numbers[0], value->numbers[1]};
}

std::string Record::word(std::string_view key) const {
  const Value* value = find(key);
  return value == nullptr || value->words.empty() ? std::string() : value->words.front();
}

Expression Record::expression(std::string_view key, std::size_t index) const {
  const Value* value = find(key);
  return value == nullptr || value->expressions.size() <= index ? Expression() : value->expressions[index];
}

Spot Record::spot(std::string_view key) const {
  const Value* value = find(key);
  return value == nullptr || value->node == nullptr ? table_spot : value->node->spot;
}

bool RecordReader::is_table(const Node& node, const std::string& path) {
  if (node.table() != nullptr) return true;
  complaints_.add(node.spot, path, describe(node), "a table is expected here", "[" + path + "] and its keys below");
  return false;
}

Record RecordReader::read(const TableSpec& spec, const Node& table_node, Spot key_spot, const std::string& path,
                          const std::string& kind) {
  Record record;
  record.table_spot = key_spot;
  record.path = path;
  if (!is_table(table_node, path)) return record;
  const Table& table = *table_node.table();
  const std::set<std::string> meant = check_keys(spec, table, record, kind);
  table_ = &spec;
  for (const KeySpec& key : spec.keys) {
    const std::string key_path = path.empty() ? key.key : path + "." + key.key;
    const Node* node = table.find(key.key);
    if (node == nullptr && key.required && !meant.contains(key.key)) {
      complaints_.add(key_spot, key_path, "no " + key.key, "this key is required: " + key.meaning, example_line(key));
    }
    const bool is_default = node == nullptr;
    if (is_default && key.fallback) node = &*key.fallback;
    if (node == nullptr) continue;
    if (std::optional<Value> value = read_value(*node, key, key_path)) {
      value->node = is_default ? nullptr : node;
      record.values.emplace(key.key, std::move(*value));
    } else {
      record.refused.insert(key.key);
    }
  }
  return record;
}

std::set<std::string> RecordReader::check_keys(const TableSpec& spec, const Table& table, Record& record,
                                               const std::string& kind) {
  std::set<std::string> meant;
  for (const Entry& entry : table.entries()) {
    const bool known = spec.find(entry.key) != nullptr ||
                       std::find(spec.children.begin(), spec.children.end(), entry.key) != spec.children.end();
    const std::string instead = known || !spec.law_keys ? "" : stated_instead(table, entry.key);
    if (known || instead == "none") continue;
    if (!instead.empty() && Schema::model().kinds_with(spec.path, entry.key).empty()) record.waiting.push_back(entry.key);
    else meant.insert(complain_of_key(spec, table, entry, record, kind));
  }
  return meant;
}

std::string RecordReader::complain_of_key(const TableSpec& spec, const Table& table, const Entry& entry, const Record& record,
                                          const std::string& kind) {
  const std::string path = record.path.empty() ? entry.key : record.path + "." + entry.key;
  const std::vector<std::string> owners = Schema::model().kinds_with(spec.path, entry.key);
  if (!owners.empty() && !kind.empty()) {
    std::string list;
    for (const std::string& owner : owners) list += (list.empty() ? "" : ", ") + owner;
    complaints_.add(entry.key_spot, path, entry.key, "this key is for " + list + " only, and this is " + kind,
                    "delete it");
    return "";
  }
  if (const std::string laws = spec.law_keys ? laws_with(entry.key) : std::string(); !laws.empty()) {
    std::string remedy = "state one of them, or delete the key";
    for (const auto& [prefix, meant] : {std::pair{"stop_", "the stops are"}, {"friction_", "friction is"}})
      if (const std::string other = prefix + entry.key; !laws_with(other).empty()) remedy = fmt::format("state one of them, or {} if {} meant", other, meant);
    complaints_.add(entry.key_spot, path, entry.key, "this key belongs to " + laws, remedy);
    return "";
  }
  if (record.path.empty() && is_parameter(table, entry.key)) {
    complaints_.add(entry.key_spot, path, "unknown key " + in_quotes(entry.key), "models have no such key, but this model has a parameter of that name", "parameters." + entry.key);
    return "";
  }
  std::vector<std::string> candidates = spec.children;
  for (const KeySpec& key : spec.keys) candidates.push_back(key.key);
  const std::string home = home_of(entry.key);
  const std::string near = home.empty() ? complaints_.nearest(entry.key, candidates) : std::string();
  complaints_.add(entry.key_spot, path, "unknown key " + in_quotes(entry.key),
                  record.path.empty() ? "models have no such key" : "there is no such key here", home + advice(near, candidates));
  return near;
}

}  // namespace pintle
