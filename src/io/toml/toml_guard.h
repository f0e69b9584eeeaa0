// Checks the brackets, keys and separators of TOML before the parser sees them: toml++ 3.3 takes some of them for granted
// (it asserts instead of rejecting them), and dotted keys can nest its tables to any depth.
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

/// The first fault in `text` that must not reach a TOML parser. Left to the parser: the inside of values and strings,
/// and whether a key is new.
std::optional<TomlProblem> first_toml_problem(std::string_view text);

}  // namespace pintle
