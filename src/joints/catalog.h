// The joint types by the word used in model files: what each forbids, what it leaves free, which keys it has.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "base/key_info.h"
#include "joints/joint_displacement.h"

namespace pintle {

using Geometry = std::map<std::string, double>;  // values of a type's own keys

/// Why values of a type's keys are inconsistent; an empty key: they are consistent.
struct GeometryFault {
  std::string key, why, remedy;
};

/// A gap component or a free coordinate: its name ("x", "angle", "slide"), its index in the relative pose (a gap that is a function
/// has index 0), and whether it is an angle [rad] or a length [m].
struct ComponentInfo {
  std::string_view name;
  int place = 0;
  bool angular = false;
};

struct JointTypeInfo {
  std::string_view word;
  std::string_view meaning;
  std::span<const ComponentInfo> gap;   // forbidden displacements, in the order of the law's components
  std::span<const ComponentInfo> free;  // what is left: coordinates that motors, plots and expressions use
  std::span<const KeyInfo> keys;        // geometry: model.joints[].geometry by key
  bool one_sided = false;               // it pulls but does not push
  bool has_ends = false;                // its free coordinate has ends, is a length, and is not available to motors and expressions: it needs stops
  JointDisplacement (*make)(const Geometry& geometry) = nullptr;  // the gap
  GeometryFault (*fault)(const Geometry& geometry) = nullptr;
};

/// Every joint type, in the manual's order.
std::span<const JointTypeInfo> joint_type_catalog();

/// The type called `word`, or nullptr.
const JointTypeInfo* find_joint_type(std::string_view word);

/// The pressure of a vacuum as a cylinder's pressures are stated [Pa]: over the surroundings', at the standard atmosphere, or absolute if it has an ambient_pressure.
double vacuum_of(const Geometry& cylinder);

/// Registers a joint type, before the first model is read. Throws std::logic_error if a type with this word exists.
void register_joint_type(const JointTypeInfo& info);

}  // namespace pintle
