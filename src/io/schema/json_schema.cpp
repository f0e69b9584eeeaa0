// The format as a JSON Schema for editors: enough for completion and hints, less strict than the reader where kinds
// of joints and motors differ.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/schema/schema.h"
#include "io/text.h"
#include "io/writers.h"
#include "joints/catalog.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Node& node) {
  if (const Table* table = node.table()) {
    Json object = Json::object();
    for (const Entry& entry : table->entries()) object[entry.key] = json_of(entry.value);
    return object;
  }
  if (const Array* array = node.array()) {
    Json list = Json::array();
    for (const Node& item : *array) list.push_back(json_of(item));
    return list;
  }
  if (const std::string* string = node.string()) return *string;
  if (const std::int64_t* integer = node.integer()) return *integer;
  if (const double* real = node.real()) return *real;
  return *node.truth();
}

// Ranges apply to bare numbers; editors cannot evaluate strings with units.
Json number_schema(const KeySpec& spec) {
  Json schema;
  schema["type"] = {"number", "string"};
  if (spec.minimum) schema[spec.minimum_exclusive ? "exclusiveMinimum" : "minimum"] = *spec.minimum;
  if (spec.maximum) schema["maximum"] = *spec.maximum;
  return schema;
}

Json list_schema(Json items, std::size_t least, std::size_t most) {
  Json schema;
  schema["type"] = "array";
  schema["items"] = std::move(items);
  if (most > 0) {
    schema["minItems"] = least;
    schema["maxItems"] = most;
  }
  return schema;
}

Json marker_schema() {
  const Json number{{"type", {"number", "string"}}};
  Json object;
  object["type"] = "object";
  for (const char* key : {"x", "y", "r", "xi", "axis"}) object["properties"][key] = number;
  object["additionalProperties"] = false;
  Json schema;
  schema["anyOf"] = {list_schema(number, 2, 3), object};
  return schema;
}

Json word_schema(const KeySpec& spec) {
  Json schema;
  schema["type"] = "string";
  if (!spec.words.empty()) schema["enum"] = spec.words;
  for (const auto& [synonym, allowed] : spec.synonyms) {
    schema["enum"].push_back(synonym);
    schema["synonyms"][synonym] = allowed;
  }
  if (spec.type == ValueType::kMarkerName || spec.type == ValueType::kMarkerNames) {
    schema["pattern"] = "^[A-Za-z0-9_-]+\\.[A-Za-z0-9_-]+$";
  }
  return schema;
}

Json type_schema(const KeySpec& spec) {
  switch (spec.type) {
    case ValueType::kInteger: {
      Json schema = number_schema(spec);
      schema["type"] = "integer";
      return schema;
    }
    case ValueType::kTruth:
      return Json{{"type", "boolean"}};
    case ValueType::kText:
    case ValueType::kWord:
    case ValueType::kMarkerName:
    case ValueType::kJointName:
    case ValueType::kTableName:
      return word_schema(spec);
    case ValueType::kColumn:
      return Json{{"type", {"string", "integer"}}};
    case ValueType::kWords:
    case ValueType::kMarkerNames:
      return list_schema(word_schema(spec), spec.count, spec.count);
    case ValueType::kQuantities:
    case ValueType::kExpressions:
      return list_schema(number_schema(spec), spec.count, spec.count);
    case ValueType::kMarker:
      return marker_schema();
    default:
      break;
  }
  Json schema = number_schema(spec);
  if (spec.per_component) {
    schema["items"] = number_schema(spec);
    schema["type"].push_back("array");
  }
  return schema;
}

std::string describe_key(const KeySpec& spec) {
  std::string text = spec.meaning;
  if (!spec.unit.empty() && spec.unit != "any") text += fmt::format(" [{}]", spec.unit);
  if (!spec.otherwise.empty()) text += fmt::format("; when absent: {}", spec.otherwise);
  return text;
}

// A key that belongs to several kinds of things, with a different meaning in each, keeps all descriptions.
void add_key(Json& properties, const KeySpec& spec) {
  const std::string description = describe_key(spec);
  if (properties.contains(spec.key)) {
    const std::string before = properties[spec.key]["description"];
    if (before != description) properties[spec.key]["description"] = before + "; or: " + description;
    return;
  }
  Json schema;
  schema["description"] = description;
  schema.update(type_schema(spec));
  if (spec.fallback) schema["default"] = json_of(*spec.fallback);
  properties[spec.key] = std::move(schema);
}

void add_catalog_keys(Json& properties, const TableSpec& table) {
  for (const JointTypeInfo& type : joint_type_catalog()) {
    if (!table.joint_type_keys) break;
    for (const KeyInfo& key : type.keys) {
      KeySpec spec = spec_of(key);
      spec.fallback.reset();
      spec.meaning = fmt::format("{}: {}", type.word, spec.meaning);
      add_key(properties, spec);
    }
  }
  for (const LawInfo& law : law_catalog()) {
    if (!table.law_keys) break;
    for (const KeyInfo& key : law.keys) {
      KeySpec spec = spec_of(key);
      if (table.path.starts_with("defaults")) spec.per_component = false;
      if (!properties.contains(spec.key)) add_key(properties, spec);  // laws use the same words for what they have in common
    }
  }
}

Json table_schema(const std::string& path);

Json child_schema(const std::string& path) {
  for (const std::string& child : Schema::model().children(path)) {
    if (child != "*") continue;
    Json schema;
    schema["type"] = "object";
    schema["additionalProperties"] = table_schema(path + ".*");
    return schema;
  }
  return table_schema(path);
}

Json table_schema(const std::string& path) {
  Json schema;
  schema["type"] = "object";
  Json properties = Json::object();
  Json required = Json::array();
  Json others = false;
  for (const TableSpec& table : Schema::model().tables()) {
    if (table.path != path) continue;
    if (table.when.empty()) schema["description"] = table.meaning;
    for (const KeySpec& key : table.keys) {
      add_key(properties, key);
      if (key.required && table.when.empty()) required.push_back(key.key);
    }
    add_catalog_keys(properties, table);
    if (table.entries) {
      others = type_schema(*table.entries);
      others["description"] = table.entries->meaning;
    }
  }
  for (const std::string& child : Schema::model().children(path)) {
    properties[child] = child_schema(path.empty() ? child : path + "." + child);
  }
  if (!properties.empty()) schema["properties"] = std::move(properties);
  if (!required.empty()) schema["required"] = std::move(required);
  schema["additionalProperties"] = std::move(others);
  return schema;
}

}  // namespace

std::string json_schema() {
  Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Pintle model file, format 1";
  schema.update(table_schema(""));
  return schema.dump(2) + "\n";
}

}  // namespace pintle
