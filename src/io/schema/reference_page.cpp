// The reference page of the model file, from the schema, the catalogs and the table of units.

#include <fmt/format.h>

#include "base/units.h"
#include "io/schema/schema.h"
#include "io/text.h"
#include "io/writers.h"
#include "joints/catalog.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

constexpr const char* kHead =
    R"(# Model file

`pintle schema --reference` writes this page from the schema that model files are checked against.

A model is one TOML file, or one JSON file with the same tree (`pintle convert` turns one into the other).
`pintle check MODEL` reports errors in a file with line and column.

## Numbers

Any number can also be a string with an expression: `"25 mm"`, `"2*crank + 5 mm"`, `"3000 N*s/m"`.
A unit binds to the number before it. A bare number is in SI units and radians. A quantity of the wrong kind is an
error. Parameter names may be used anywhere; "expression of" in a table lists further variables.

- operators: `+ - * / ^`, unary `-`, comparisons `< > <= >=` (1 or 0), parentheses
- functions: `sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs sign min max pow step(x) smoothstep(a, b, x) if(condition, then, else)`; `smoothstep` rises from 0 where x is a to 1 where it is b
- tables: `NAME(x)` of a [`[table.NAME]`](#tablename)
- constants: `pi`, `e`
- variables: those that the table names. Where these are [coordinates](#coordinates): `t` and what moves

### Coordinates

Forces and efforts of motors may depend on where things are and how they move:

- of a joint `J` with one free coordinate: `J.angle` or `J.slide`, `J.rate`; of one with two, as a slot: `J.slide`, `J.slide_rate`, `J.angle`, `J.angle_rate`
- of a body `B`, in the world's axes: `B.x`, `B.y`, `B.angle`, `B.vx`, `B.vy`, `B.spin`
- of its marker `M`: `B.M.x` and so on
- in a motor: `angle` or `slide`, and `rate`, of its own joint

A distance is `sqrt((A.x - B.x)^2 + (A.y - B.y)^2)`. What is written with these is differentiated exactly. Forces of joints cannot be read, as they depend on what reads them; what they come from can, as the stretch of a rope.
)";

constexpr const char* kMarkers =
    R"(
A marker is a point with an axis direction, in one of the forms

- `[x, y]` or `[x, y, axis]`
- `{ x = 1, y = 2, axis = "90 deg" }`
- `{ r = "6 m", xi = "30 deg", axis = 0 }`: distance and direction from the origin

Lengths are in m, angles in rad; `axis` is 0 if it is not stated. A joint names its markers as `body.marker`.
)";

std::string code(std::string_view text) {
  return text.empty() ? std::string() : fmt::format("`{}`", text);
}

std::string node_text(const Node& node) {
  if (const Array* array = node.array()) {
    std::string text;
    for (const Node& item : *array) text += (text.empty() ? "" : ", ") + node_text(item);
    return "[" + text + "]";
  }
  if (const std::string* string = node.string()) return quoted_exactly(*string);
  if (const bool* truth = node.truth()) return *truth ? "true" : "false";
  if (const double* real = node.real()) return fmt::format("{}", *real);
  return number_text(node);
}

std::string list_of(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? std::string() : std::string(between)) + code(word);
  return text;
}

std::string variables_of(const KeySpec& spec) {
  std::string text;
  for (const std::string& variable : spec.variables) text += (text.empty() ? "" : ", ") + (variable == "joints" ? "[coordinates](#coordinates)" : code(variable));
  return text;
}

std::string type_text(const KeySpec& spec) {
  switch (spec.type) {
    case ValueType::kInteger:
      return "integer";
    case ValueType::kText:
      return "text";
    case ValueType::kWord:
      return list_of(spec.words, " or ");
    case ValueType::kWords:
      return "list of " + (spec.words.empty() ? "strings" : list_of(spec.words, ", "));
    case ValueType::kQuantities:
      return spec.count == 0 ? "list of numbers" : fmt::format("list of {} numbers", spec.count);
    case ValueType::kExpression:
      return "expression of " + variables_of(spec);
    case ValueType::kExpressions:
      return fmt::format("list of {} expressions of {}", spec.count, variables_of(spec));
    case ValueType::kTruth:
      return "`true` or `false`";
    case ValueType::kMarker:
      return "marker";
    case ValueType::kMarkerName:
      return "`\"body.marker\"`";
    case ValueType::kMarkerNames:
      return "list of two `\"body.marker\"`";
    case ValueType::kJointName:
      return "name of a joint";
    case ValueType::kTableName:
      return "name of a table";
    case ValueType::kColumn:
      return "text or integer";
    default:
      if (!spec.variables.empty()) return "number, or expression of " + variables_of(spec);
      return spec.per_component ? "number, or a list with one per linear gap component" : "number";
  }
}

std::string default_text(const KeySpec& spec) {
  if (spec.required) return "required";
  if (spec.fallback) return code(node_text(*spec.fallback));
  return spec.otherwise;
}

std::string range_text(const KeySpec& spec) {
  std::string text;
  if (spec.minimum) text = fmt::format("{} {}", spec.minimum_exclusive ? ">" : ">=", *spec.minimum);
  if (spec.maximum) text += fmt::format("{}<= {}", text.empty() ? "" : ", ", *spec.maximum);
  return text;
}

std::string key_rows(const std::vector<KeySpec>& keys) {
  if (keys.empty()) return {};
  std::string text = "\n| key | value | unit | range | default | meaning |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const KeySpec& spec : keys) {
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(spec.key), type_text(spec), spec.unit,
                        range_text(spec), default_text(spec), spec.meaning);
  }
  return text;
}

std::string heading(const TableSpec& table) {
  if (table.path.empty()) return "Top level";
  std::string path = table.path;
  if (const std::size_t star = path.find('*'); star != std::string::npos) path.replace(star, 1, "NAME");
  const std::string kind = table.when.empty() ? "" : ", " + table.called;
  return fmt::format("`[{}]`{}", path, kind);
}

std::string table_text(const TableSpec& table) {
  std::string text = fmt::format("\n## {}\n\n{}\n", heading(table), table.meaning);
  if (table.path == "ground.markers") text += kMarkers;
  if (table.entries && table.path != "ground.markers") {
    text += fmt::format("Each entry: {}.\n", table.entries->meaning);
  }
  text += key_rows(table.keys);
  if (table.joint_type_keys) text += "\nSee also the keys of the [joint types](#joint-types).\n";
  if (table.law_keys) text += "\nSee also the keys of the [joint laws](#joint-laws).\n";
  return text;
}

std::vector<KeySpec> specs_of(std::span<const KeyInfo> keys, bool measured_when_absent) {
  std::vector<KeySpec> specs;
  for (const KeyInfo& key : keys) {
    specs.push_back(spec_of(key));
    if (!measured_when_absent) continue;
    specs.back().fallback.reset();
    if (key.otherwise.empty()) specs.back().otherwise = "as assembled";
  }
  return specs;
}

std::string components_text(std::span<const ComponentInfo> components) {
  std::string text;
  for (const ComponentInfo& component : components) {
    text += fmt::format("{}{} [{}]", text.empty() ? "" : ", ", component.name, component.angular ? "rad" : "m");
  }
  return text.empty() ? "nothing" : text;
}

std::string joint_types_text() {
  std::string text =
      "\n## Joint types\n\nThe gap is the forbidden displacement, in frame F of the first marker; the law resists it. "
      "Motors, plots\nand expressions use the free coordinates.\n\n| type | description | gap | free |\n| --- | --- | --- | --- |\n";
  for (const JointTypeInfo& type : joint_type_catalog()) {
    text += fmt::format("| {} | {} | {} | {} |\n", code(type.word), type.meaning, components_text(type.gap),
                        components_text(type.free));
  }
  for (const JointTypeInfo& type : joint_type_catalog()) {
    if (type.keys.empty()) continue;
    text += fmt::format("\nKeys of {} joints:\n", code(type.word)) + key_rows(specs_of(type.keys, true));
  }
  return text;
}

std::string laws_text() {
  std::string text = "\n## Joint laws\n";
  for (const LawInfo& law : law_catalog()) {
    text += fmt::format("\n### {}\n\n{}\n", code(law.word), law.meaning) + key_rows(specs_of(law.keys, false));
  }
  return text;
}

std::string units_text() {
  std::string text = "\n## Units\n\nCombine them with `*`, `/` and integer exponents: `\"kg*m^2\"`, `\"N*m*s/rad\"`.\n\n";
  std::string line;
  for (const std::string_view symbol : unit_symbols()) line += (line.empty() ? "" : ", ") + code(symbol);
  return text + line + "\n";
}

}  // namespace

std::string reference_markdown() {
  std::string text = kHead;
  for (const TableSpec& table : Schema::model().tables()) text += table_text(table);
  return text + joint_types_text() + laws_text() + units_text();
}

}  // namespace pintle
