// The JSON Schema judges models as the reader does: a small validator of the keywords it uses, over every mechanism.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "io/writers.h"
#include "results/disk.h"

namespace pintle {
namespace {

using Json = nlohmann::json;

const std::set<std::string> kKeywords{
    "$schema",    "title",      "description",          "type",          "enum",          "default", "required",
    "properties", "items",      "additionalProperties", "minimum",       "maximum",       "pattern", "minItems",
    "maxItems",   "anyOf",      "exclusiveMinimum",     "minProperties", "propertyNames", "$id",     "examples",
    "const",      "uniqueItems"};

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

std::string fault(const Json& value, const Json& schema, const std::string& path);

std::string fault_in_object(const Json& value, const Json& schema, const std::string& path) {
  for (const Json& key : schema.value("required", Json::array()))
    if (!value.contains(key)) return path + ": no " + key.get<std::string>();
  const Json properties = schema.value("properties", Json::object());
  const Json others = schema.value("additionalProperties", Json(true));
  for (const auto& [key, inner] : value.items()) {
    if (schema.contains("propertyNames"))
      if (std::string text = fault(key, schema["propertyNames"], path + "." + key); !text.empty()) return text;
    const Json& rule = properties.contains(key) ? properties[key] : others;
    if (std::string text = fault(inner, rule, path + "." + key); !text.empty()) return text;
  }
  return {};
}

std::string fault_in_array(const Json& value, const Json& schema, const std::string& path) {
  if (value.size() < schema.value("minItems", 0U)) return path + ": too few";
  if (value.size() > schema.value("maxItems", value.size())) return path + ": too many";
  if (!schema.contains("items")) return {};
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Json& rule = schema["items"].is_array() ? schema["items"].at(i) : schema["items"];
    if (std::string text = fault(value[i], rule, path + "[" + std::to_string(i) + "]"); !text.empty()) return text;
  }
  return {};
}

std::string fault_in_number(double value, const Json& schema, const std::string& path) {
  if (schema.contains("minimum") && value < schema["minimum"].get<double>()) return path + ": too small";
  if (schema.contains("maximum") && value > schema["maximum"].get<double>()) return path + ": too large";
  if (schema.contains("exclusiveMinimum") && value <= schema["exclusiveMinimum"].get<double>())
    return path + ": too small";
  return {};
}

std::string fault_in_type(const Json& value, const Json& schema, const std::string& path) {
  if (!schema.contains("type")) return {};
  const Json& type = schema["type"];
  bool good = false;
  for (const Json& one : type.is_array() ? type : Json::array({type})) good = good || is_of_type(value, one);
  return good ? std::string() : path + ": not " + type.dump();
}

std::string fault_in_choice(const Json& value, const Json& schema, const std::string& path) {
  if (!schema.contains("anyOf")) return {};
  std::string faults;
  for (const Json& choice : schema["anyOf"]) {
    const std::string text = fault(value, choice, path);
    if (text.empty()) return {};
    faults += text + "; ";
  }
  return faults;
}

// The first thing in `value` that the schema forbids; empty if there is none.
std::string fault(const Json& value, const Json& schema, const std::string& path) {
  if (schema.is_boolean()) return schema.get<bool>() ? "" : path + ": not allowed";
  for (const auto& [keyword, rule] : schema.items()) EXPECT_TRUE(kKeywords.count(keyword)) << keyword;
  if (std::string text = fault_in_type(value, schema, path); !text.empty()) return text;
  if (schema.contains("enum") && std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
    return path + ": none of " + schema["enum"].dump();
  if (std::string text = fault_in_choice(value, schema, path); !text.empty()) return text;
  if (value.is_string() && schema.contains("pattern") &&
      !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
    return path + ": does not match";
  if (value.is_number()) return fault_in_number(value, schema, path);
  if (value.is_object()) return fault_in_object(value, schema, path);
  return value.is_array() ? fault_in_array(value, schema, path) : std::string();
}

std::string fault_of_model(const std::string& text) {
  return fault(Json::parse(to_json(parse_toml(text, "x.toml"))), Json::parse(json_schema()), "model");
}

std::filesystem::path mechanisms() {
  return std::filesystem::path(PINTLE_SOURCE_DIR) / "mechanisms";
}

TEST(JsonSchemaJudges, EveryMechanismIsGood) {
  for (const auto& file : std::filesystem::directory_iterator(mechanisms())) {
    if (file.path().extension() == ".toml") {
      EXPECT_EQ(fault_of_model(read_file(file.path())), "") << file.path();
    }
  }
}

TEST(JsonSchemaJudges, MistakesAreBad) {
  const std::string good =
      "format = 1\n[body.a]\nmass = \"1 kg\"\ninertia = 1\nmarkers.O = [0, 0]\n[ground.markers]\nO = [0, 0]\n";
  ASSERT_EQ(fault_of_model(good), "");
  const auto with = [&good](const char* line) { return fault_of_model(line + ("\n" + good)); };
  EXPECT_EQ(with("colour = 1"), "model.colour: not allowed");
  EXPECT_NE(with("gravity = 3"), "");
  EXPECT_NE(with("gravity = [1, 2, 3]"), "");
  EXPECT_NE(with("space = \"plana\""), "");
  EXPECT_NE(with("body.x.inertia = 1"), "");
  EXPECT_NE(with("body.x = { mass = -1, inertia = 1 }"), "");
  EXPECT_NE(with("body.x = { mass = 1, inertia = 1, colour = 2 }"), "");
  EXPECT_NE(with("joint.x = { type = \"ball\", between = [\"a.b\", \"c.d\"] }"), "");
  EXPECT_NE(with("joint.x = { type = \"revolute\", between = [\"a.b\"] }"), "");
}

}  // namespace
}  // namespace pintle
