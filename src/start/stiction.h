// Joints held at rest by dry friction carry their load from the start. theory/assembly section 6.
#pragma once

#include "start/settle_joints.h"

namespace pintle {

/// Settles `start` (settle_joints). If sticking friction can hold joints that would otherwise begin to move, the start is computed again with these joints held,
/// and their friction is loaded with the forces that this needs. Joints that friction cannot hold start to slip; their laws in the returned system record that.
/// `unloaded`: the start from which start_forces made `start`, for a run of this duration; `known_span`: as in settle_joints.
System settle_with_stiction(System system, const BasicSettledStart<Planar>& unloaded, double duration, double known_span, BasicSettledStart<Planar>& start);

}  // namespace pintle
