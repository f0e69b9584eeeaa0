// [spring], [torsion_spring] and [force].

#include "io/reading/model_reading.h"
#include "io/text.h"

namespace pintle {
namespace {

void check_preload(ModelReading& reading, const Record& record, const std::string& free_key) {
  if (!record.states("preload") || !record.states(free_key)) return;
  reading.complaints.add(record.spot("preload"), record.path + ".preload", "preload and " + free_key,
                         "each determines the other", "delete one of them");
}

// A value that was complained about counts as doing something.
void check_spring_does_something(ModelReading& reading, const Table& stated, const Record& record, const Spring& spring) {
  for (const char* key : {"stiffness", "damping", "preload"})
    if (stated.find(key) != nullptr) return;
  reading.complaints.add(record.table_spot, record.path, "neither stiffness nor damping nor preload",
                         "such a spring does nothing",
                         spring.torsion ? "stiffness = \"10 N*m/rad\"" : "stiffness = \"1e3 N/m\"");
}

void read_spring(ModelReading& reading, const Entry& entry, bool torsion) {
  const std::string section_key = torsion ? "torsion_spring" : "spring";
  const std::string free_key = torsion ? "free_angle" : "free_length";
  const std::string path = section_key + "." + entry.key;
  check_name(reading, entry, path);
  const Record record = reading.records.read(reading.spec(section_key + ".*"), entry.value, entry.key_spot, path);
  Spring spring;
  spring.name = entry.key;
  spring.torsion = torsion;
  read_between(reading, record, "spring", spring.first, spring.second);
  spring.stiffness = record.number("stiffness");
  spring.damping = record.number("damping");
  spring.free_length = record.maybe_number(free_key);
  spring.preload = record.maybe_number("preload");
  if (entry.value.table() != nullptr) check_spring_does_something(reading, *entry.value.table(), record, spring);
  check_preload(reading, record, free_key);
  reading.model.springs.push_back(std::move(spring));
}

void read_force(ModelReading& reading, const Entry& entry) {
  const std::string path = "force." + entry.key;
  check_name(reading, entry, path);
  const Record record = reading.records.read(reading.spec("force.*"), entry.value, entry.key_spot, path);
  AppliedForce force;
  force.name = entry.key;
  if (const Value* on = record.find("on")) force.on = read_marker_ref(reading, *on->node, path + ".on");
  if (force.on.body == "ground") {
    reading.complaints.add(record.spot("on"), path + ".on", in_quotes(record.word("on")),
                           "a force on the ground moves nothing", "a marker of a body");
  }
  force.force = {record.expression("force", 0), record.expression("force", 1)};
  force.torque = record.expression("torque");
  force.body_axes = record.word("axes") == "body";
  reading.model.forces.push_back(std::move(force));
}

}  // namespace

void read_loads(ModelReading& reading) {
  let_expressions_read_coordinates(reading);
  const Table& springs = section(reading, "spring");
  const Table& torsion_springs = section(reading, "torsion_spring");
  for (const Entry& entry : springs.entries()) read_spring(reading, entry, false);
  for (const Entry& entry : torsion_springs.entries()) {
    read_spring(reading, entry, true);
    if (springs.find(entry.key) == nullptr) continue;
    reading.complaints.add(entry.key_spot, "torsion_spring." + entry.key, in_quotes(entry.key),
                           "a spring has this name too, and their results would collide", "another name");
  }
  for (const Entry& entry : section(reading, "force").entries()) read_force(reading, entry);
}

}  // namespace pintle
