// Joints that dry friction holds at rest carry their load from the start. theory/assembly section 6.
#pragma once

#include "start/settle_joints.h"

namespace pintle {

/// Settles `start` (settle_joints). Where friction that sticks can hold joints which would begin to move without it, it is made again with these joints held, and
/// their friction is loaded with what that takes. Those whose friction cannot hold them start to slip; their laws in the system that is returned know it.
/// `unloaded`: that from which start_forces made `start`, of a run of this duration; `known_span` as settle_joints has it.
System settle_with_stiction(System system, const BasicSettledStart<Planar>& unloaded, double duration, double known_span, BasicSettledStart<Planar>& start);

}  // namespace pintle
