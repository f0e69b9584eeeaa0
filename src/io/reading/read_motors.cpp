// [motor].

#include <algorithm>

#include "base/text/article.h"
#include "io/reading/model_reading.h"
#include "io/text.h"
#include "joints/catalog.h"

namespace pintle {
namespace {

// The free coordinate that the motor acts on, "angle" or "slide"; "" after a complaint.
std::string coordinate_of(ModelReading& reading, const Entry& entry, const std::string& path) {
  const Node* joint = entry.value.table() == nullptr ? nullptr : entry.value.table()->find("joint");
  if (joint == nullptr || joint->string() == nullptr) return {};
  const auto it = reading.type_of_joint.find(*joint->string());
  if (it == reading.type_of_joint.end()) {
    std::vector<std::string> names;
    for (const auto& [name, type] : reading.type_of_joint) names.push_back(name);
    reading.complaints.add(joint->spot, path + ".joint", in_quotes(*joint->string()), "there is no such joint",
                           reading.complaints.did_you_mean(*joint->string(), names));
    return {};
  }
  const JointTypeInfo* type = find_joint_type(it->second);
  if (type == nullptr) return {};
  if (!type->free.empty() && !type->has_ends) return std::string(type->free.front().name);
  reading.complaints.add(joint->spot, path + ".joint", in_quotes(*joint->string()),
                         type->has_ends ? with_article(it->second) + " is driven by its pressures" : with_article(it->second) + " joint leaves no coordinate free for a motor",
                         "a revolute, prismatic or slot joint");
  return {};
}

// Exactly one of the three must be stated (a faulty one counts as stated).
void check_choice(ModelReading& reading, const Entry& entry, const std::string& path, const std::string& effort) {
  std::vector<const Entry*> stated;
  for (const std::string& key : {effort, std::string("speed"), std::string("position")}) {
    if (const Entry* found = entry.value.table()->find_entry(key)) stated.push_back(found);
  }
  if (stated.empty()) {
    reading.complaints.add(entry.key_spot, path, "no " + effort + ", speed or position", "a motor needs one of them",
                           effort == "torque" ? "torque = \"5 N*m\"" : "force = \"5 N\"");
  } else if (stated.size() > 1) {
    reading.complaints.add(stated[1]->key_spot, path + "." + stated[1]->key, stated[0]->key + " and " + stated[1]->key,
                           "a motor needs exactly one of " + effort + ", speed and position", "delete one of them");
  }
  const bool servo = stated.empty() || stated.front()->key != effort;
  for (const char* key : {"stiffness", "damping"}) {
    const Entry* found = entry.value.table()->find_entry(key);
    if (servo || found == nullptr) continue;
    reading.complaints.add(found->key_spot, path + "." + key, key, "only servos (speed, position) have it",
                           "delete it");
  }
}

void check_servos(ModelReading& reading, const Motor& motor, Spot spot, std::map<std::string, std::string>& servo_of) {
  if (motor.kind == MotorKind::kEffort || motor.joint.empty()) return;
  const auto [it, is_new] = servo_of.emplace(motor.joint, motor.name);
  if (is_new) return;
  reading.complaints.add(spot, "motor." + motor.name + ".joint", in_quotes(motor.joint),
                         "motor " + it->second + " is already a servo on this joint: they would conflict", "one of them");
}

void read_motor(ModelReading& reading, const Entry& entry, std::map<std::string, std::string>& servo_of) {
  const std::string path = "motor." + entry.key;
  check_name(reading, entry, path);
  if (!reading.records.is_table(entry.value, path)) return;
  const std::string coordinate = coordinate_of(reading, entry, path);
  if (coordinate.empty() && entry.value.table()->find("joint") != nullptr &&
      entry.value.table()->find("joint")->string() != nullptr) {
    return;  // without the joint, nothing else can be judged
  }
  const std::string effort = coordinate == "slide" ? "force" : "torque";
  const std::string when = coordinate.empty() ? "angle" : coordinate;
  const Record record =
      reading.records.read(reading.spec("motor.*", when), entry.value, entry.key_spot, path,
                           when == "angle" ? "a motor in a revolute joint" : "a motor in a sliding joint");
  check_choice(reading, entry, path, effort);
  Motor motor;
  motor.name = entry.key;
  motor.joint = record.word("joint");
  motor.stiffness = record.number("stiffness", motor.stiffness);
  motor.damping = record.number("damping", motor.damping);
  if (record.states("speed")) {
    motor.kind = MotorKind::kSpeed;
    const std::optional<double> constant = record.maybe_number("speed");
    motor.law = constant ? Expression::constant(*constant) : record.expression("speed");
  } else {
    motor.kind = record.states("position") ? MotorKind::kPosition : MotorKind::kEffort;
    motor.law = record.expression(motor.kind == MotorKind::kPosition ? "position" : effort);
  }
  check_servos(reading, motor, record.spot("joint"), servo_of);
  reading.model.motors.push_back(std::move(motor));
}

}  // namespace

void read_motors(ModelReading& reading) {
  let_expressions_read_coordinates(reading);
  std::map<std::string, std::string> servo_of;
  for (const Entry& entry : section(reading, "motor").entries()) read_motor(reading, entry, servo_of);
}

}  // namespace pintle
