// The law of a joint, chosen on the command line with its keys.
#pragma once

#include "io/complaints.h"
#include "io/document.h"

namespace pintle {

/// The text of the source is "joint.NAME=law" and keys of this law behind commas: "joint.A=maxwell,branch_ratio=[1, 2],damping=2". A word of a
/// friction law chooses the joint's friction, any other the law that holds it. Keys that the joint states for its former law stay where the
/// new one has them and are left out where it has not; a note of the document says which. Complains where the joint or the law does not
/// exist, or the law has no such key; whether it suits the joint is seen when the model is read.
void choose_law(Document& document, int source, Complaints& complaints);

}  // namespace pintle
