// [ground] and [body].

#include "io/reading/model_reading.h"
#include "io/text.h"

namespace pintle {
namespace {

std::vector<Marker> read_markers(ModelReading& reading, const Entry& owner, const std::string& path,
                                 std::set<std::string>& names) {
  std::vector<Marker> markers;
  if (owner.value.table() == nullptr) return markers;  // complained about where the owner is read
  const Node* node = owner.value.table()->find("markers");
  if (node == nullptr || !reading.records.is_table(*node, path + ".markers")) return markers;
  for (const Entry& entry : node->table()->entries()) {
    const std::string marker_path = path + ".markers." + entry.key;
    check_name(reading, entry, marker_path);
    names.insert(entry.key);
    // A faulty one keeps its name: expressions that read it are not at fault.
    std::optional<Marker> marker = reading.records.read_marker(entry, marker_path);
    markers.push_back(marker ? std::move(*marker) : Marker{.name = entry.key});
  }
  return markers;
}

// "x" and "y" need the position, "angle" the angle: without it there is no value to hold.
void read_hold(ModelReading& reading, const Record& record, Body& body) {
  const Value* hold = record.find("hold");
  if (hold == nullptr || hold->node == nullptr) return;
  for (std::size_t i = 0; i < hold->words.size(); ++i) {
    const std::string& word = hold->words[i];
    const bool is_angle = word == "angle";
    body.hold[is_angle ? 2 : word == "y" ? 1 : 0] = true;
    const std::string needed = is_angle ? "angle" : "position";
    if (record.states(needed) || record.refused.contains(needed)) continue;
    reading.complaints.add((*hold->node->array())[i].spot, record.path + ".hold", in_quotes(word),
                           "a held value must be stated, and there is no " + needed,
                           needed + (is_angle ? " = \"30 deg\"" : " = [0, 0]"));
  }
}

// A settled start begins at rest.
void check_at_rest(ModelReading& reading, const Record& record, const Body& body) {
  if (reading.model.simulate.start != Start::kSettled) return;
  const auto complain = [&](const std::string& key) {
    reading.complaints.add(record.spot(key), record.path + "." + key, key, "simulate.start is \"settled\", so that the run begins at rest", "delete " + key + ", or start = \"assembled\"");
  };
  if (body.velocity && *body.velocity != Vec2{0, 0}) complain("velocity");
  if (body.spin && *body.spin != 0) complain("spin");
}

void read_body(ModelReading& reading, const Entry& entry) {
  const std::string path = "body." + entry.key;
  check_name(reading, entry, path);
  if (entry.key == "ground") {
    reading.complaints.add(entry.key_spot, path, "\"ground\"", "this name is reserved for the world",
                           "[ground.markers], or another name");
  }
  const Record record = reading.records.read(reading.spec("body.*"), entry.value, entry.key_spot, path);
  Body body;
  body.name = entry.key;
  body.mass = record.number("mass", 1);
  body.inertia = record.number("inertia", 1);
  body.position = record.maybe_pair("position");
  body.angle = record.maybe_number("angle");
  body.velocity = record.maybe_pair("velocity");
  body.spin = record.maybe_number("spin");
  read_hold(reading, record, body);
  check_at_rest(reading, record, body);
  body.markers = read_markers(reading, entry, path, reading.markers_of[entry.key]);
  reading.model.bodies.push_back(std::move(body));
}

}  // namespace

void read_bodies(ModelReading& reading) {
  std::set<std::string>& ground = reading.markers_of["ground"];
  if (const Entry* entry = reading.root.find_entry("ground")) {
    reading.records.read(reading.spec("ground"), entry->value, entry->key_spot, "ground");
    reading.model.ground = read_markers(reading, *entry, "ground", ground);
  }
  for (const Entry& entry : section(reading, "body").entries()) read_body(reading, entry);
  if (reading.model.bodies.empty()) {
    reading.complaints.add({0, 1, 1}, "body", "no bodies", "a model has at least one",
                           "[body.crank] with mass and inertia");
  }
}

}  // namespace pintle
