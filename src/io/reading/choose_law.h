// The law of a joint, chosen on the command line with its keys.
#pragma once

#include "io/complaints.h"
#include "io/document.h"

namespace pintle {

/// The source's text is "joint.NAME=law", followed by keys of this law after commas: "joint.A=maxwell,branch_ratio=[1, 2],damping=2". The name
/// of a friction law chooses the joint's friction, any other name the law that holds the joint. Keys that the joint states for its former law are
/// kept if the new law has them and dropped otherwise; a note of the document says which. Complains if the joint or the law does not exist,
/// or if the law has no such key. Whether the law suits the joint is checked when the model is read.
void choose_law(Document& document, int source, Complaints& complaints);

}  // namespace pintle
