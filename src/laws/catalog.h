// The joint laws by the word used in model files. A new law is its file, one line in catalog.cpp, and its test.
#pragma once

#include <span>
#include <string_view>

#include "base/key_info.h"

namespace pintle {

struct LawInfo {
  std::string_view word;
  std::string_view meaning;
  std::span<const KeyInfo> keys;
};

/// Every law, in the manual's order.
std::span<const LawInfo> law_catalog();

/// The law called `word`, or nullptr.
const LawInfo* find_law(std::string_view word);

}  // namespace pintle
