// From a model file to a model.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pintle/complaint.h"
#include "pintle/model.h"

namespace pintle {

/// Reads a model file, TOML or JSON. Each override, "joint.A.stiffness=2e8", replaces or adds one value before anything
/// is checked; "--law joint.A=maxwell,damping=2" chooses a joint's law and drops what only the former one has. Throws InputError with everything that is wrong, FileError if the file cannot be read.
Model read_model(const std::string& path, const std::vector<std::string>& overrides = {});

/// Gives the text of a file that a model names, such as `file = "gas.csv"` of a table, by the name as it stands there: relative to the
/// model's folder. Throws FileError where there is none.
using FileText = std::function<std::string(const std::string& name)>;

/// The same from a text; `file_name` is for messages, and its ending (.toml or .json) tells the form. A model that names a file is complained
/// about where there is no `files`.
Model parse_model(std::string_view text, std::string_view file_name, const std::vector<std::string>& overrides = {}, const FileText& files = {});

}  // namespace pintle
