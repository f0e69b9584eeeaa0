// Which keys of a law have an effect in a joint.
#pragma once

#include <algorithm>

#include "base/key_info.h"
#include "joints/catalog.h"
#include "laws/catalog.h"

namespace pintle {

/// Keys "angular_..." apply to a constrained angle, which not every joint has.
inline bool has_effect(const KeyInfo& key, const JointTypeInfo& type) {
  return !key.key.starts_with("angular_") || std::any_of(type.gap.begin(), type.gap.end(), [](const ComponentInfo& component) { return component.angular; });
}

/// Whether there is a law and it has this key.
inline bool has_key(const LawInfo* law, std::string_view key) {
  return law != nullptr && find_key(law->keys, key) != nullptr;
}

}  // namespace pintle
