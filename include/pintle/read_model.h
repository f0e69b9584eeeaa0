// Reads a model from a model file.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pintle/complaint.h"
#include "pintle/model.h"

namespace pintle {

/// Reads a model file, TOML or JSON. Each override, "joint.A.stiffness=2e8", replaces or adds one value before anything is checked; "--law joint.A=maxwell,damping=2" chooses a joint's law and drops
/// the keys that only the former law has. Throws InputError with everything that is wrong, FileError if the file cannot be read.
Model read_model(const std::string& path, const std::vector<std::string>& overrides = {});

/// Returns the text of a file that a model names, such as `file = "gas.csv"` of a table. The name is as written in the model: relative
/// to the model's folder. Throws FileError if there is no such file.
using FileText = std::function<std::string(const std::string& name)>;

/// The same from a text; `file_name` is for messages, and its ending (.toml or .json) determines the format. Without `files`, a model that
/// names a file gets a complaint.
Model parse_model(std::string_view text, std::string_view file_name, const std::vector<std::string>& overrides = {}, const FileText& files = {});

}  // namespace pintle
