// [defaults.joint] and [joint].

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/text/article.h"
#include "base/units.h"
#include "io/reading/law_keys.h"
#include "io/reading/model_reading.h"
#include "io/text.h"
#include "joints/cam_profile.h"
#include "joints/catalog.h"
#include "joints/edge_profile.h"
#include "laws/catalog.h"

namespace pintle {
namespace {

constexpr std::string_view kPin = "revolute";

std::size_t linear_components(const JointTypeInfo& type) {
  const auto linear = [](const ComponentInfo& component) { return !component.angular; };
  return static_cast<std::size_t>(std::count_if(type.gap.begin(), type.gap.end(), linear));
}

// A word of the joint, read before the rest because the keys depend on it; "" if it is missing or not a string.
std::string word_ahead(const Node& joint, std::string_view key) {
  const Node* node = joint.table() == nullptr ? nullptr : joint.table()->find(key);
  return node == nullptr || node->string() == nullptr ? std::string() : *node->string();
}

const LawInfo* law_of_role(std::string_view word, LawRole role) {
  const LawInfo* law = find_law(word);
  return law != nullptr && law->role == role ? law : nullptr;
}

// The friction law of the defaults, if the joint can have it.
const LawInfo* default_friction(const JointTypeInfo* type, const LawInfo* law, const Record& defaults) {
  if (type == nullptr || law == nullptr || !defaults.states("friction")) return nullptr;
  const LawInfo* friction = law_of_role(defaults.word("friction"), LawRole::kFriction);
  return friction != nullptr && suits(*friction, type->word) && !law->rubs ? friction : nullptr;
}

// The friction law that the joint states, or else that of the defaults, unless the joint is ideal.
const LawInfo* friction_of(const Node& joint, const JointTypeInfo* type, const LawInfo* law, const Record& defaults) {
  if (joint.table() != nullptr && joint.table()->find("friction") != nullptr) return law_of_role(word_ahead(joint, "friction"), LawRole::kFriction);
  const LawInfo* friction = default_friction(type, law, defaults);
  const Node* ideal = joint.table() == nullptr ? nullptr : joint.table()->find("ideal");
  const bool rigid = ideal != nullptr && ideal->truth() != nullptr && *ideal->truth();
  return rigid ? nullptr : friction;
}

TableSpec& joint_spec(ModelReading& reading, const Node& joint, const JointTypeInfo* type, const LawInfo* law, const std::string& friction, const std::string& stops,
                      const std::string& detent) {
  const std::string type_word(type == nullptr ? "" : type->word);
  const std::string law_word(law == nullptr ? "" : law->word);
  // spec() makes the specs and `reading` owns them, so they may be completed here: the number of entries of lists, and which
  // keys a table supplies.
  TableSpec& spec = const_cast<TableSpec&>(reading.spec("joint.*", type_word, law_word, friction, stops, detent));
  for (KeySpec& key : spec.keys) {
    if (key.per_component && type != nullptr) key.count = linear_components(*type);
  }
  for (const KeyInfo& key : law == nullptr ? std::span<const KeyInfo>() : law->keys)
    for (const std::string_view point : key.points)
      for (KeySpec& given : spec.keys)
        if (given.key == point) given.required = joint.table() == nullptr || joint.table()->find(key.key) == nullptr;
  return spec;
}

// A joint of invalid type or law: its keys cannot be judged, but what all joints share can.
void read_faulty_joint(ModelReading& reading, const Entry& entry, const std::string& path) {
  TableSpec spec = reading.spec("joint.*");
  for (KeySpec& key : spec.keys)
    if (key.per_component) key.type = ValueType::kMarker;  // value skipped: the allowed length of its list is not known
  if (entry.value.table() != nullptr) {
    for (const Entry& inner : entry.value.table()->entries()) {
      const bool special = !Schema::model().kinds_with("joint.*", inner.key).empty();
      if (!special || spec.find(inner.key) != nullptr) continue;
      KeySpec key;
      key.key = inner.key;
      key.type = ValueType::kMarker;  // value skipped
      spec.keys.push_back(key);
    }
  }
  const Record record = reading.records.read(spec, entry.value, entry.key_spot, path);
  MarkerRef first;
  MarkerRef second;
  read_between(reading, record, "joint", first, second);
}

// The values as a law or a joint type takes them: numbers, or the index of a word among the key's words.
std::vector<double> numbers_of(const KeyInfo& key, const Value& value) {
  if (key.words.empty()) return value.numbers;
  return {static_cast<double>(std::find(key.words.begin(), key.words.end(), value.words.front()) - key.words.begin())};
}

void read_geometry(const JointTypeInfo& type, const Record& record, Joint& joint) {
  for (const KeyInfo& key : type.keys) {
    if (!key.words.empty()) {
      if (record.states(key.key)) joint.geometry[std::string(key.key)] = numbers_of(key, *record.find(key.key)).front();
    } else if (const auto number = record.maybe_number(key.key)) joint.geometry[std::string(key.key)] = *number;
    else if (key.of_time && record.states(key.key)) joint.functions[std::string(key.key)] = record.expression(key.key);
  }
  if (type.word != "gear") return;
  if (const auto radii = record.maybe_pair("radii")) {
    joint.geometry["radius_first"] = (*radii)[0];
    joint.geometry["radius_second"] = (*radii)[1];
  }
  joint.geometry["internal"] = record.word("mesh") == "internal" ? 1 : 0;
}

void check_gear(ModelReading& reading, const Record& record, const Joint& joint) {
  const auto radii = record.maybe_pair("radii");
  if (joint.type != "gear" || !radii || (*radii)[0] != (*radii)[1] || record.word("mesh") != "internal") return;
  reading.complaints.add(record.spot("radii"), record.path + ".radii", "two equal radii",
                         "a gear cannot turn inside one of its own size",
                         "mesh = \"external\", or two different radii");
}

void read_cam(ModelReading& reading, const Record& record, Joint& joint) {
  if (joint.type != "cam" || !record.states("lift") || !record.states("base_radius")) return;
  joint.cam = Cam{record.expression("lift"), record.number("base_radius"), record.number("roller_radius"), record.word("follower") == "flat"};
  if (joint.cam->flat && joint.cam->roller_radius > 0)
    reading.complaints.add(record.spot("roller_radius"), record.path + ".roller_radius", "roller_radius", "a flat face has no roller", "delete it");
  if (std::string why = CamProfile(*joint.cam).fault(); !why.empty())
    reading.complaints.add(record.spot("lift"), record.path + ".lift", in_quotes(joint.cam->lift.text()), std::move(why), "a lift that is smooth and ends as it begins (a table: interpolation = \"spline\"), a larger base_radius, or a smaller roller");
}

void read_edge(ModelReading& reading, const Record& record, Joint& joint) {
  if (joint.type != "edge" || !record.states("height") || !record.states("from") || !record.states("to")) return;
  joint.edge = Edge{record.expression("height"), record.number("roller_radius"), record.number("from"), record.number("to")};
  if (!(joint.edge->to > joint.edge->from)) {
    reading.complaints.add(record.spot("to"), record.path + ".to", fmt::format("{:g} m", joint.edge->to), fmt::format("this is not above from, {:g} m", joint.edge->from), "a larger x");
    return;
  }
  if (std::string why = EdgeProfile(*joint.edge).fault(); !why.empty())
    reading.complaints.add(record.spot("height"), record.path + ".height", in_quotes(joint.edge->height.text()), std::move(why), "a height that is smooth (a table: interpolation = \"spline\", outside = \"extend\"; a corner: rounded with smoothstep), or a smaller roller");
}

// Reports a fault of a law or of a geometry at the place of its key. The joint may have its value from `defaults`.
template <class Fault>
void complain_of(const Fault& fault, const Record& record, ModelReading& reading, const Record* defaults = nullptr) {
  const auto stated_in = [&fault](const Record& table) {
    const Value* value = table.find(fault.key);
    return value != nullptr && value->node != nullptr ? describe(*value->node) : std::string();
  };
  std::string found = stated_in(record);
  if (found.empty() && defaults != nullptr)
    if (const std::string usual = stated_in(*defaults); !usual.empty()) found = usual + " of [defaults.joint]";
  reading.complaints.add(record.spot(fault.key), record.path + "." + fault.key, found.empty() ? "no " + fault.key : found, fault.why, fault.remedy);
}

// Whether the values of the type's keys are consistent.
void check_geometry(ModelReading& reading, const JointTypeInfo& type, const Record& record, const Node& stated_joint, const Joint& joint) {
  if (type.has_ends && stated_joint.table() != nullptr && (stated_joint.table()->find("stops") == nullptr || word_ahead(stated_joint, "stops") == "none"))
    reading.complaints.add(record.spot("stops"), record.path, "no stops", "the " + std::string(type.free.front().name) + " ends somewhere", "stops = \"hard\" or \"cushioned\", with stop_stiffness");
  const bool complete = std::all_of(type.keys.begin(), type.keys.end(), [&](const KeyInfo& key) { return !key.required || joint.geometry.contains(std::string(key.key)); });
  if (type.fault == nullptr || !complete) return;
  Geometry stated = joint.geometry;
  for (const auto& [key, function] : joint.functions) stated.emplace(key, 0);
  const GeometryFault fault = type.fault(stated);
  if (fault.key.empty()) return;
  complain_of(fault, record, reading);
}

// If the joint takes its points from a table, a fault in them is the table's: "displacement" is its x, "force" its y.
void blame_the_table(const LawInfo& law, const Record& record, LawFault& fault) {
  if (record.states(fault.key)) return;
  for (const KeyInfo& key : law.keys) {
    const auto point = std::find(key.points.begin(), key.points.end(), fault.key);
    if (point == key.points.end() || !record.states(key.key)) continue;
    fault.key = key.key;
    fault.why = fmt::format("its {}: {}", point == key.points.begin() ? 'x' : 'y', fault.why);
    return;
  }
}

// Whether the law suits the joint and, if each value is valid by itself, whether the values are consistent.
void check_law(ModelReading& reading, const JointTypeInfo& type, const LawInfo& law, const Record& record, const Record& defaults, const Joint& joint, const LawChoice& choice, bool complete) {
  if (!suits(law, type.word)) {
    std::string types;
    for (const std::string_view one : law.joints) types += (types.empty() ? "" : ", ") + std::string(one);
    const std::string key(key_of(law.role));
    reading.complaints.add(record.spot(key), record.path + "." + key, '"' + choice.word + '"', with_article(type.word) + " joint cannot have it",
                           "it is for joints of type " + types);
    return;
  }
  LawSetting setting;
  setting.joint_type = type.word;
  for (const ComponentInfo& gap : type.gap) setting.held[gap.place] = true;
  for (const ComponentInfo& free : type.free) setting.free[free.place] = true;
  setting.one_sided = type.one_sided;
  setting.take(joint.geometry);
  setting.values = &choice.values;
  setting.keys = law.keys;
  for (const KeyInfo& key : law.keys)
    if (record.states(key.key)) setting.stated.push_back(key.key);
  if (law.fault == nullptr || !complete) return;
  LawFault fault = law.fault(setting);
  if (fault.key.empty()) return;
  blame_the_table(law, record, fault);
  complain_of(fault, record, reading, &defaults);
}

// The points of the table that a key names, as values of the two keys that the table replaces.
bool take_points(ModelReading& reading, const KeyInfo& key, const LawInfo& law, const Record& record, const Value& named, LawChoice& choice) {
  const std::string path = record.path + "." + std::string(key.key);
  const std::string& name = named.words.front();
  const auto complain = [&](std::string because, std::string suggestion) {
    reading.complaints.add(named.node->spot, path, in_quotes(name), std::move(because), std::move(suggestion));
    return false;
  };
  const auto it = reading.tables.find(name);
  if (it == reading.tables.end()) {
    std::vector<std::string> names;
    for (const auto& [known, table] : reading.tables) names.push_back(known);
    return complain("the model has no such table", names.empty() ? "[table." + name + "] with x and y" : reading.complaints.did_you_mean(name, names));
  }
  const NamedTable& table = it->second;
  if (table.x.empty()) return false;  // complained about at the table itself
  for (const std::string_view stated : key.points)
    if (record.states(stated)) return complain(std::string(stated) + " states the points too", "delete one of them");
  const std::array<const std::vector<double>*, 2> points{&table.x, &table.y};
  const std::array<const Dimension*, 2> dimensions{&table.in_scope.argument, &table.in_scope.result};
  for (std::size_t i = 0; i < 2; ++i) {
    const KeyInfo* info = find_key(law.keys, key.points[i]);
    if (auto problem = check_dimension(*dimensions[i], parse_unit(info->unit)->dimension)) return complain(fmt::format("its {}: {}", i == 0 ? "x" : "y", *problem), "a table of another kind");
    choice.values[std::string(info->key)] = *points[i];
  }
  return true;
}

// [defaults.joint] accepts what at least one law allows.
void check_default(ModelReading& reading, const KeyInfo& key, const JointTypeInfo& type, const LawInfo& law, const std::string& joint, const Record& defaults, const Value& value) {
  if (!key.words.empty() || !key.points.empty()) return;
  for (const double number : value.numbers)
    if (const std::string problem = range_problem(number, spec_of(key, &type)); !problem.empty())
      reading.complaints.add(defaults.spot(key.key), "defaults.joint." + std::string(key.key), fmt::format("{:.6g}", number), fmt::format("for the law {} of {} {}", law.word, joint, problem),
                             fmt::format("a value that all joints can have, or {} in {}", key.key, joint));
}

// `stated_joint` is the joint's table: if a key in it has no value, that was complained about.
void read_law(ModelReading& reading, const JointTypeInfo& type, const LawInfo& law, const Record& record, const Node& stated_joint,
              const Record& defaults, const Joint& joint, LawChoice& choice) {
  const auto is_stated = [&stated_joint](std::string_view key) { return stated_joint.table() != nullptr && stated_joint.table()->find(key) != nullptr; };
  choice.word = law.word;
  bool complete = true;
  std::vector<std::string> missing;  // unless a table gives them
  for (const KeyInfo& key : law.keys) {
    const bool stated = record.states(key.key);
    if (stated && !has_effect(key, type)) {
      reading.complaints.add(record.spot(key.key), record.path + "." + std::string(key.key), std::string(key.key),
                             with_article(type.word) + " joint forbids no angle, so this has no effect",
                             "delete it");
    }
    const Value* value = stated || !defaults.states(key.key) ? record.find(key.key) : defaults.find(key.key);
    if (value != nullptr && !stated && defaults.states(key.key)) check_default(reading, key, type, law, record.path, defaults, *value);
    if (!key.points.empty()) {
      if (value != nullptr && !take_points(reading, key, law, record, *value, choice)) complete = false;
    } else if (value != nullptr) choice.values[std::string(key.key)] = numbers_of(key, *value);
    else if (choice.values.count(std::string(key.key)) == 0 && (key.otherwise.empty() || is_stated(key.key))) missing.push_back(std::string(key.key));
  }
  for (const std::string& key : missing) complete = complete && choice.values.count(key) > 0;
  check_law(reading, type, law, record, defaults, joint, choice, complete);
}

void read_bearing(ModelReading& reading, const JointTypeInfo& type, const Entry& joint, const std::string& joint_path, std::optional<Bearing>& out) {
  const Entry* entry = joint.value.table() == nullptr ? nullptr : joint.value.table()->find_entry("bearing");
  if (entry == nullptr) return;
  const std::string path = joint_path + ".bearing";
  if (type.word != kPin) {
    reading.complaints.add(entry->key_spot, path, "bearing", with_article(type.word) + " joint has no pin that turns in a bearing", "delete it, or state the bearing of a revolute joint");
    return;
  }
  const Record record = reading.records.read(reading.spec("joint.*.bearing"), entry->value, entry->key_spot, path);
  out = Bearing{record.word("type"), record.maybe_number("dynamic_load_rating"), record.maybe_number("static_load_rating"), record.maybe_number("fatigue_load_limit"),
                record.maybe_number("pin_diameter"), record.maybe_number("pin_length"), record.maybe_number("wear_coefficient")};
}

// The pin that has friction and the pin of the bearing are the same pin.
void check_pin_size(ModelReading& reading, const Record& record, const Entry& joint, const Joint& out) {
  if (!out.bearing || !out.bearing->pin_diameter || !record.states("pin_radius")) return;
  const std::optional<double> radius = record.maybe_number("pin_radius");
  const double diameter = *out.bearing->pin_diameter;
  if (!radius || std::abs(2 * *radius - diameter) <= 1e-6 * diameter) return;
  const Entry& bearing = *joint.value.table()->find_entry("bearing");
  reading.complaints.add(bearing.value.table()->find_entry("pin_diameter")->value.spot, record.path + ".bearing.pin_diameter", fmt::format("{:.6g} m", diameter),
                         fmt::format("the joint's own pin_radius is {:.6g} m, which is another pin", *radius), fmt::format("pin_diameter = {:.6g}, or the radius that fits", 2 * *radius));
}

// What [defaults.joint] states, directly or through a table that it names, is not required of any joint.
void do_without(const LawInfo& law, const Record& defaults, TableSpec& spec) {
  const auto given = [&](const std::string& key) {
    return defaults.states(key) || std::any_of(law.keys.begin(), law.keys.end(), [&](const KeyInfo& info) { return defaults.states(info.key) && std::find(info.points.begin(), info.points.end(), key) != info.points.end(); });
  };
  for (KeySpec& key : spec.keys) key.required = key.required && !given(key.key);
}

void read_joint(ModelReading& reading, const Entry& entry, const Record& defaults) {
  const std::string path = "joint." + entry.key;
  check_name(reading, entry, path);
  const std::string law_word = word_ahead(entry.value, "law");
  const JointTypeInfo* type = find_joint_type(word_ahead(entry.value, "type"));
  const LawInfo* law = law_of_role(law_word.empty() ? "linear" : law_word, LawRole::kHolds);
  const LawInfo* friction = friction_of(entry.value, type, law, defaults);
  const std::string friction_word(friction == nullptr ? "" : friction->word);
  const std::string stops_word = word_ahead(entry.value, "stops");
  const LawInfo* stops = law_of_role(stops_word, LawRole::kStops);
  const std::string detent_word = word_ahead(entry.value, "detent");
  const LawInfo* detent = law_of_role(detent_word, LawRole::kDetent);
  reading.type_of_joint[entry.key] = type == nullptr ? "" : std::string(type->word);
  // If the friction law does not exist, the keys that belong to it are unknown.
  const std::string rubs = word_ahead(entry.value, "friction");
  if (type == nullptr || law == nullptr || (friction == nullptr && !rubs.empty() && rubs != "none")) {
    read_faulty_joint(reading, entry, path);
    return;
  }
  const std::string kind = with_article(type->word) + " joint";
  TableSpec spec = joint_spec(reading, entry.value, type, law, friction_word, stops == nullptr ? "" : stops_word, detent == nullptr ? "" : detent_word);
  do_without(*law, defaults, spec);
  const Record record = reading.records.read(spec, entry.value, entry.key_spot, path, kind);
  if (!record.waiting.empty()) reading.model.notes.push_back(fmt::format("joint {}: {} {} of other laws than the stated one, without effect", entry.key, fmt::join(record.waiting, ", "), record.waiting.size() == 1 ? "is a key" : "are keys"));
  Joint joint;
  joint.name = entry.key;
  joint.type = type->word;
  read_between(reading, record, "joint", joint.first, joint.second);
  read_geometry(*type, record, joint);
  check_gear(reading, record, joint);
  check_geometry(reading, *type, record, entry.value, joint);
  read_cam(reading, record, joint);
  read_edge(reading, record, joint);
  read_law(reading, *type, *law, record, entry.value, defaults, joint, joint.law);
  joint.ideal = record.number("ideal") > 0;
  if (friction != nullptr) read_law(reading, *type, *friction, record, entry.value, defaults, joint, joint.friction);
  if (stops != nullptr) read_law(reading, *type, *stops, record, entry.value, defaults, joint, joint.stops);
  if (detent != nullptr) read_law(reading, *type, *detent, record, entry.value, defaults, joint, joint.detent);
  if (friction != nullptr && joint.ideal)
    reading.complaints.add(record.spot("friction"), path + ".friction", '"' + friction_word + '"', "an ideal joint does not deflect, so the force that presses its surfaces together is not known",
                           "ideal = false, or no friction");
  if (joint.ideal && !record.states("friction") && default_friction(type, law, defaults) != nullptr)
    reading.model.notes.push_back("joint " + entry.key + ": it is ideal, and the friction of [defaults.joint] does not act in it");
  if (friction != nullptr && law->rubs)
    reading.complaints.add(record.spot("friction"), path + ".friction", '"' + friction_word + '"', "a joint with law \"" + std::string(law->word) + "\" has friction of its own, where the bodies touch",
                           "friction_coefficient, and no friction");
  read_bearing(reading, *type, entry, path, joint.bearing);
  check_pin_size(reading, record, entry, joint);
  reading.model.joints.push_back(std::move(joint));
}

Record read_defaults(ModelReading& reading) {
  const Entry* defaults = reading.root.find_entry("defaults");
  if (defaults == nullptr) return {};
  reading.records.read(reading.spec("defaults"), defaults->value, defaults->key_spot, "defaults");
  const Entry* joint = defaults->value.table() == nullptr ? nullptr : defaults->value.table()->find_entry("joint");
  if (joint == nullptr) return {};
  TableSpec spec = reading.spec("defaults.joint");
  for (KeySpec& key : spec.keys) key.per_component = false;  // joints differ in their number of components
  return reading.records.read(spec, joint->value, joint->key_spot, "defaults.joint");
}

}  // namespace

void read_joints(ModelReading& reading) {
  const Record defaults = read_defaults(reading);
  for (const Entry& entry : section(reading, "joint").entries()) read_joint(reading, entry, defaults);
}

}  // namespace pintle
