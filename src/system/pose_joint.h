// Joints whose gap is the relative pose of their markers itself, less an offset: pins, sliders, welds, pins in slots.
#pragma once

#include <variant>

#include "system/system.h"

namespace pintle {

/// Motors have such gaps too, but are excluded.
inline bool is_pose_joint(const JointData& joint) { return joint.servo < 0 && std::holds_alternative<Selection>(joint.displacement); }

}  // namespace pintle
