// Values from the command line, put into a document before it is checked.
#pragma once

#include <string>
#include <vector>

#include "io/document.h"

namespace pintle {

/// Each override is "path.to.key=value". The value is read as TOML if it is that ("2e8", "[0, 1]", "true"), else as a
/// string ("25 mm", "radau"). Tables on the way are added if they are missing, but no new bodies, joints and so on.
void apply_overrides(Document& document, const std::vector<std::string>& overrides);

}  // namespace pintle
