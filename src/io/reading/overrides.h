// Values from the command line, put into a document before it is checked.
#pragma once

#include <string>
#include <vector>

#include "io/complaints.h"
#include "io/document.h"

namespace pintle {

/// Each override is "path.to.key=value". The value is read as TOML if it is valid TOML ("2e8", "[0, 1]", "true"), else as
/// a string ("25 mm", "radau"). Missing tables on the way are added, but no new bodies, joints and so on.
/// Alternatively an override chooses the law of a joint: "--law joint.A=maxwell,damping=2", see choose_law.
void apply_overrides(Document& document, const std::vector<std::string>& overrides);

/// The value of an override, which starts at this column of the source.
Node read_override_value(const std::string& text, int source, int column);

/// Complains that the model has no thing of this name in the section; `spot` is where the name stands.
void complain_of_unknown_name(Complaints& complaints, const Table& section, const std::string& section_name, const std::string& name, Spot spot);

}  // namespace pintle
