// The model as text: read, written, edited, checked.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/document.h"
#include "io/schema/schema.h"
#include "io/toml/edit_toml.h"
#include "io/writers.h"
#include "joints/catalog.h"
#include "laws/catalog.h"
#include "pintle/check.h"
#include "pintle/read_model.h"
#include "results/studies/check_report.h"
#include "studio/kernel/exchange.h"

namespace pintle::studio {
namespace {

Json key_json(const KeyInfo& key) {
  Json out = {{"name", key.key}, {"unit", key.unit.empty() ? "-" : key.unit}, {"meaning", key.meaning}};
  if (std::isfinite(key.minimum)) out["minimum"] = key.minimum;
  if (!key.angular_unit.empty()) out["angular_unit"] = key.angular_unit;
  if (!key.required && key.words.empty() && key.otherwise.empty()) out["default"] = key.fallback;
  if (!key.otherwise.empty()) out["otherwise"] = key.otherwise;
  if (!key.words.empty()) out["words"] = std::vector<std::string>(key.words.begin(), key.words.end());
  if (!key.required && !key.words.empty()) out["default"] = out["words"][static_cast<std::size_t>(key.fallback)];
  if (key.list) out["list"] = true;
  return out;
}

template <class List>
Json keys_json(const List& keys) {
  Json out = Json::array();
  for (const KeyInfo& key : keys) out.push_back(key_json(key));
  return out;
}

Json text_answer(const std::string& text) { return {{"ok", true}, {"text", text}, {"complaints", Json::array()}}; }

Json refused(const InputError& error) { return {{"ok", false}, {"complaints", to_json(error.complaints())}}; }

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') out += "\\n";
    else out += c;
  }
  return out + '"';
}

std::string as_toml(const Json& value) {
  if (value.is_string()) return quoted(value.get<std::string>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer()) return fmt::format("{}", value.get<std::int64_t>());
  if (value.is_number()) return fmt::format("{:#}", value.get<double>());
  std::string out;
  if (value.is_array()) {
    for (const Json& entry : value) out += (out.empty() ? "" : ", ") + as_toml(entry);
    return "[" + out + "]";
  }
  if (!value.is_object()) throw CallFault("A model value is a number, a string, a boolean, a list or a table.", "");
  for (const auto& [key, entry] : value.items()) out += (out.empty() ? "" : ", ") + key + " = " + as_toml(entry);
  return "{ " + out + " }";
}

Json warning(const char* kind, const std::string& message, const std::string& hint, const std::vector<std::string>& joints = {},
             const std::vector<std::string>& bodies = {}) {
  return {{"kind", kind}, {"message", message}, {"hint", hint}, {"joints", joints}, {"bodies", bodies}};
}

Json redundancy_warning(const CheckRedundancy& group) {
  std::vector<std::string> joints;
  for (const auto& member : group.members)
    if (std::find(joints.begin(), joints.end(), member.joint) == joints.end()) joints.push_back(member.joint);
  const auto& most = group.members.front();
  return warning("redundant", fmt::format("The joints {} have {} too many and can load each other.", fmt::join(joints, ", "),
                                          group.degree == 1 ? "one constraint" : fmt::format("{} constraints", group.degree)),
                 fmt::format("Their forces depend on their stiffness and on how well the parts fit. To avoid it, free {} of joint {}: a slot instead of a pin, a pin instead of a slider.",
                             most.component, most.joint),
                 joints);
}

Json mobility_warnings(const CheckReport& report) {
  Json out = Json::array();
  const CheckMobility& m = report.mobility;
  std::vector<std::string> held;
  for (const CheckRedundancy& group : report.redundancies)
    for (const auto& member : group.members)
      if (std::find(held.begin(), held.end(), member.joint) == held.end()) held.push_back(member.joint);
  if (m.mobility == 0 && m.rank >= 0)
    out.push_back(warning("immobile", "The mechanism cannot move: its joints hold every body.",
                          held.empty() ? "Remove a joint, or replace one with a freer type: a slot instead of a pin." : fmt::format("Remove one of the joints {}, or free it: a slot instead of a pin.", fmt::join(held, ", ")), held));
  if (m.singular_position())
    out.push_back(warning("singular", "The mechanism is in a singular position: here it has extra degrees of freedom, or a force may be unbounded.",
                          "Start from a slightly different position, unless this is intended."));
  if (m.servos > 0 && m.mobility_driven >= 0 && m.mobility >= 0 && m.servos > m.mobility - m.mobility_driven)
    out.push_back(warning("driven", fmt::format("{} motors that hold a speed or a position drive {} degree{} of freedom: they work against each other.", m.servos, m.mobility - m.mobility_driven,
                                                m.mobility - m.mobility_driven == 1 ? "" : "s"),
                          "Remove a motor, or give one a torque instead of a speed."));
  return out;
}

Json warnings_of(const CheckReport& report) {
  Json out = mobility_warnings(report);
  for (const CheckRedundancy& group : report.redundancies)
    if (!group.members.empty()) out.push_back(redundancy_warning(group));
  for (const auto& group : report.topology.floating)
    out.push_back(warning("floating", fmt::format("No joint connects {} to the ground.", fmt::join(group, ", ")), "Connect one of them to the ground, unless it is meant to move freely.", {}, group));
  if (!report.passed()) out.push_back(warning("formula", "A formula of the model disagrees with finite differences, or the energy account does not close.", "pintle check --details names it."));
  for (const std::string& note : report.notes) out.push_back(warning("note", note, "", joints_named_in(note)));
  return out;
}

}  // namespace

Json schema(Exchange&) { return Json::parse(json_schema()); }

Json catalog(Exchange&) {
  Json laws = Json::array(), types = Json::array();
  for (const LawInfo& law : law_catalog())
    laws.push_back({{"word", law.word}, {"meaning", law.meaning}, {"role", key_of(law.role)}, {"keys", keys_json(law.keys)}});
  for (const JointTypeInfo& type : joint_type_catalog()) {
    Json free = Json::array(), gap = Json::array(), words = Json::array();
    for (const LawInfo& law : law_catalog())
      if (suits(law, type.word)) words.push_back(law.word);
    for (const ComponentInfo& component : type.free) free.push_back(component.name);
    for (const ComponentInfo& component : type.gap) gap.push_back(component.name);
    types.push_back({{"word", type.word}, {"meaning", type.meaning}, {"gap", gap}, {"free", free}, {"geometry", keys_json(type.keys)}, {"laws", words}});
  }
  return {{"joint_types", types}, {"laws", laws}, {"methods", Schema::model().assemble("simulate").find("method")->words}};
}

Json read(Exchange& call) {
  const std::string text = text_argument(call, "text"), name = name_for(text);
  Json out = {{"ok", false}};
  try {
    const Document document = parse_document(text, name);
    out["model"] = Json::parse(pintle::to_json(document));
    out["resolved"] = resolved(parse_model(text, name, {}, files_argument(call)));
    out["ok"] = true;
    out["complaints"] = Json::array();
  } catch (const InputError& error) {
    out["complaints"] = to_json(error.complaints());
  }
  return out;
}

Json write(Exchange& call) {
  const auto it = call.arguments.find("model");
  if (it == call.arguments.end() || !it->is_object()) throw CallFault("The call lacks \"model\", an object.", "This is a fault of the page: reload it.");
  try {
    return text_answer(to_toml(parse_document(dump(*it), "model.json")));
  } catch (const InputError& error) {
    return refused(error);
  }
}

Json edit(Exchange& call) {
  const std::string text = text_argument(call, "text");
  try {
    return text_answer(with_value(text, name_for(text), call.arguments.at("path").get<std::vector<std::string>>(), as_toml(call.arguments.at("value"))));
  } catch (const InputError& error) {
    return refused(error);
  }
}

Json format(Exchange& call) {
  const std::string text = text_argument(call, "text");
  try {
    return text_answer(format_toml(text, "model.toml"));
  } catch (const InputError& error) {
    return refused(error);
  }
}

Json check(Exchange& call) {
  const std::string text = text_argument(call, "text");
  const Model model = parse_model(text, name_for(text), {}, files_argument(call));
  const CheckReport report = check_model(model);
  Json out = Json::parse(check_json(report, model.name, ""));
  out["warnings"] = warnings_of(report);
  return out;
}

}  // namespace pintle::studio
