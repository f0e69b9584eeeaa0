// Documents and formats as text.
#pragma once

#include <string>
#include <string_view>

#include "io/document.h"

namespace pintle {

/// The tree as TOML or JSON; reading it back gives the same tree (strings with units stay strings).
std::string to_toml(const Document& document);
std::string to_json(const Document& document);

/// TOML with tidy spacing, indentation and blank lines. Comments, the order of keys and every value stay as they are
/// written; formatting the result again changes nothing. Throws InputError if `text` is not TOML.
std::string format_toml(std::string_view text, std::string_view file_name);

/// A JSON Schema (draft 7) of the model file, for editors. The same for the TOML and the JSON form.
std::string json_schema();

/// The reference page of the model file, in Markdown.
std::string reference_markdown();

}  // namespace pintle
