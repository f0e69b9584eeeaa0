// The joint types by the word used in model files: what each forbids, what it leaves free, which keys it brings.
#pragma once

#include <span>
#include <string_view>

#include "base/key_info.h"

namespace pintle {

/// A gap component or a free coordinate: its name ("x", "angle", "slide") and whether it is an angle [rad] or a length [m].
struct ComponentInfo {
  std::string_view name;
  bool angular = false;
};

struct JointTypeInfo {
  std::string_view word;
  std::string_view meaning;
  std::span<const ComponentInfo> gap;   // forbidden displacements, in the order of the law's components
  std::span<const ComponentInfo> free;  // what is left: coordinates that motors, plots and expressions use
  std::span<const KeyInfo> keys;        // geometry: model.joints[].geometry by key
};

/// Every joint type, in the manual's order.
std::span<const JointTypeInfo> joint_type_catalog();

/// The type called `word`, or nullptr.
const JointTypeInfo* find_joint_type(std::string_view word);

}  // namespace pintle
