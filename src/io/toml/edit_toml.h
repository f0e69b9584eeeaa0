// One value of a model file changed in its text; everything else, comments too, stays as the user wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// `text` with `toml_value` at `path` ({"joint", "A", "stiffness"}): in the place of the value that stands there, or as a new
/// line at the end of its table. The ending of `file_name` tells TOML from JSON. Throws InputError when the table is written
/// in a form that cannot be extended (an inline table).
std::string with_value(std::string_view text, std::string_view file_name, const std::vector<std::string>& path, const std::string& toml_value);

}  // namespace pintle
