// Looks at the brackets, keys and separators of TOML before the parser does: toml++ 3.3 takes some of them for granted
// (it asserts rather than refuses), and dotted keys may nest its tables without end.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/document.h"

namespace pintle {

struct TomlProblem {
  Spot spot;
  std::string found;
  std::string because;
  std::string suggestion;
};

/// The first thing in `text` that no TOML parser needs to see. What is left to the parser: the inside of values and
/// strings, and whether a key is new.
std::optional<TomlProblem> first_toml_problem(std::string_view text);

}  // namespace pintle
