// Changes one value in the text of a model file; everything else, including comments, stays as the user wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// `text` with `toml_value` at `path` ({"joint", "A", "stiffness"}): it replaces the value there, or is added as a new
/// line at the end of its table. The extension of `file_name` distinguishes TOML from JSON. Throws InputError if the table
/// is written in a form that cannot be extended (an inline table).
std::string with_value(std::string_view text, std::string_view file_name, const std::vector<std::string>& path, const std::string& toml_value);

}  // namespace pintle
