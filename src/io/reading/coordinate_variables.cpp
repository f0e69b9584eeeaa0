// Variables of efforts and forces besides time: joint coordinates, positions and rates of bodies and markers.
#include <set>

#include "base/text/text_scanner.h"
#include "base/units.h"
#include "io/reading/model_reading.h"
#include "joints/catalog.h"

namespace pintle {
namespace {

using Variables = std::vector<std::pair<std::string, Dimension>>;

void add_joint(const std::string& name, const std::string& type_word, Variables& variables) {
  const JointTypeInfo* type = find_joint_type(type_word);
  if (type == nullptr || type->free.empty() || type->has_ends) return;
  for (const ComponentInfo& coordinate : type->free) {
    variables.emplace_back(name + "." + std::string(coordinate.name), coordinate.angular ? kAngle : kLength);
    variables.emplace_back(name + "." + std::string(coordinate.name) + "_rate", coordinate.angular ? kAngularSpeed : kLinearSpeed);
  }
  variables.emplace_back(name + ".rate", type->free.front().angular ? kAngularSpeed : kLinearSpeed);
}

// Every name before a dot in the text. Big models have many joints, so only those mentioned become variables.
std::set<std::string> names_before_dots(std::string_view text) {
  const auto in_name = [](char c) { return is_word_part(c) || c == '-'; };
  std::set<std::string> names;
  for (std::size_t dot = text.find('.'); dot != std::string_view::npos; dot = text.find('.', dot + 1)) {
    std::size_t start = dot;
    while (start > 0 && in_name(text[start - 1])) {
      --start;
      if (is_word_start(text[start])) names.emplace(text.substr(start, dot - start));
    }
  }
  return names;
}

void add_mentioned_joints(const ModelReading& reading, std::string_view text, Variables& variables) {
  constexpr std::size_t kFew = 100;
  if (reading.type_of_joint.size() <= kFew) {  // all of them: this allows suggestions for misspelt ones
    for (const auto& [name, type] : reading.type_of_joint) add_joint(name, type, variables);
    return;
  }
  for (const std::string& name : names_before_dots(text)) {
    const auto it = reading.type_of_joint.find(name);
    if (it != reading.type_of_joint.end()) add_joint(name, it->second, variables);
  }
}

void add_place(const std::string& name, Variables& variables) {
  for (const char* length : {".x", ".y"}) variables.emplace_back(name + length, kLength);
  for (const char* speed : {".vx", ".vy"}) variables.emplace_back(name + speed, kLinearSpeed);
  variables.emplace_back(name + ".angle", kAngle);
  variables.emplace_back(name + ".spin", kAngularSpeed);
}

// If a joint and a body have the same name, the angle is the joint's.
void add_mentioned_bodies(const ModelReading& reading, std::string_view text, Variables& variables) {
  const std::set<std::string> names = names_before_dots(text);
  for (const std::string& name : names) {
    const auto body = reading.markers_of.find(name);
    if (body == reading.markers_of.end() || name == "ground") continue;
    add_place(name, variables);
    for (const std::string& marker : body->second)
      if (names.contains(marker)) add_place(name + "." + marker, variables);
  }
}

}  // namespace

void let_expressions_read_coordinates(ModelReading& reading) {
  reading.records.joint_variables = [&reading](std::string_view text, Variables& variables) {
    add_mentioned_joints(reading, text, variables);
    add_mentioned_bodies(reading, text, variables);
  };
}

}  // namespace pintle
