// One key that a law or a joint type adds to the model file: used by the reader, the schema and the manual page.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

namespace pintle {

struct KeyInfo {
  std::string_view key;
  std::string_view unit;           // "N/m"; "" for a pure number
  std::string_view angular_unit{};  // for a value in a joint's free coordinate, if that is an angle: "N*m/rad"; "": the same unit everywhere
  double fallback = 0;             // value when absent
  double minimum = 0;              // smallest value allowed
  bool minimum_exclusive = false;  // the minimum itself is refused
  bool required = false;
  bool per_component = false;      // may be a list, one value for each gap component it covers
  bool list = false;               // is a list of any length
  bool of_time = false;            // may be an expression of t
  std::span<const std::string_view> also_of{};  // and of these variables
  std::span<const std::string_view> words{};  // the value is one of these words and is stored as its index
  std::span<const std::string_view> points{};  // may be the name of a table, whose x and y replace these two keys, which are lists
  std::string_view otherwise{};    // meaning of its absence, if that is not a number
  std::string_view meaning;        // one line
};

/// The one called `key`, or nullptr.
inline const KeyInfo* find_key(std::span<const KeyInfo> keys, std::string_view key) {
  const auto found = std::find_if(keys.begin(), keys.end(), [key](const KeyInfo& info) { return info.key == key; });
  return found == keys.end() ? nullptr : &*found;
}

}  // namespace pintle
