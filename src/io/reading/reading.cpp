// Functions shared by the reading steps.

#include "io/reading/model_reading.h"
#include "io/text.h"

namespace pintle {
namespace {

// The name with every character that a name cannot have replaced by _.
std::string usable_name(std::string_view name) {
  std::string usable;
  for (const char c : name.substr(0, 60)) {
    if (!is_continuation_byte(c)) usable += is_bare_key({&c, 1}) ? c : '_';
  }
  return usable.empty() ? "a" : usable;
}

std::vector<std::string> keys_of(const std::map<std::string, std::set<std::string>, std::less<>>& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

// A marker of the model as an example, from the body of that name if there is one.
std::string example_marker(const ModelReading& reading, const std::string& body) {
  const auto named = reading.markers_of.find(body);
  if (named != reading.markers_of.end()) {
    if (named->second.empty()) return "body." + body + ".markers.A = [0, 0], and \"" + body + ".A\" here";
    std::string list;
    for (const std::string& marker : named->second) list += (list.empty() ? "" : " or ") + in_quotes(body + "." + marker);
    return list;
  }
  for (const auto& [owner, markers] : reading.markers_of)
    if (!markers.empty()) return in_quotes(owner + "." + *markers.begin());
  return "\"ground.A\"";
}

}  // namespace

const TableSpec& ModelReading::spec(const std::string& path, const std::string& when, const std::string& law, const std::string& friction, const std::string& stops,
                                     const std::string& detent) {
  const std::string key = path + ' ' + when + ' ' + law + ' ' + friction + ' ' + stops + ' ' + detent;
  const auto it = specs.find(key);
  if (it != specs.end()) return it->second;
  return specs.emplace(key, Schema::model().assemble(path, when, law, friction, stops, detent)).first->second;
}

const Table& section(ModelReading& reading, std::string_view key) {
  static const Table kEmpty;
  const Node* node = reading.root.find(key);
  if (node == nullptr || !reading.records.is_table(*node, std::string(key))) return kEmpty;
  return *node->table();
}

void check_name(ModelReading& reading, const Entry& entry, const std::string& path) {
  if (is_bare_key(entry.key)) return;
  reading.complaints.add(entry.key_spot, path, in_quotes(entry.key), "names are made of letters, digits, _ and -",
                         usable_name(entry.key));
}

MarkerRef read_marker_ref(ModelReading& reading, const Node& node, const std::string& path) {
  const std::string& text = *node.string();
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos || text.find('.', dot + 1) != std::string::npos) {
    reading.complaints.add(node.spot, path, in_quotes(text), "a marker is named as body.marker", example_marker(reading, text));
    return {};
  }
  const MarkerRef ref{text.substr(0, dot), text.substr(dot + 1)};
  const auto body = reading.markers_of.find(ref.body);
  if (body == reading.markers_of.end()) {
    const std::vector<std::string> bodies = keys_of(reading.markers_of);
    const std::string near = reading.complaints.nearest(ref.body, bodies);
    reading.complaints.add(node.spot, path, in_quotes(text), "there is no body " + in_quotes(ref.body),
                           advice(near.empty() ? near : near + "." + ref.marker, bodies));
  } else if (body->second.count(ref.marker) == 0) {
    const std::string owner = ref.body == "ground" ? ref.body : "body." + ref.body;
    const std::vector<std::string> names(body->second.begin(), body->second.end());
    const std::string near = reading.complaints.nearest(ref.marker, names);
    reading.complaints.add(
        reading.complaints.document().inside(node, dot + 1), path, in_quotes(text),
        (ref.body == "ground" ? "the ground" : "body " + ref.body) + " has no marker " + in_quotes(ref.marker),
        names.empty() ? owner + ".markers." + ref.marker + " = [0, 0]"
                      : advice(near.empty() ? near : ref.body + "." + near, names));
  }
  return ref;
}

void read_between(ModelReading& reading, const Record& record, const std::string& thing, MarkerRef& first,
                  MarkerRef& second) {
  const Value* value = record.find("between");
  if (value == nullptr) return;
  const Array& list = *value->node->array();
  const std::string path = record.path + ".between";
  first = read_marker_ref(reading, list[0], path);
  second = read_marker_ref(reading, list[1], path);
  if (first.body.empty() || first.body != second.body) return;
  const bool on_ground = first.body == "ground";
  reading.complaints.add(record.spot("between"), path, in_quotes(*list[0].string()) + " and " + in_quotes(*list[1].string()),
                         on_ground ? "both ends are on the ground, which does not move"
                                   : "a " + thing + " between body " + first.body + " and itself does nothing",
                         "markers of two different bodies");
}

}  // namespace pintle
