// "a cam joint", "an edge joint".
#pragma once

#include <string>
#include <string_view>

namespace pintle {

/// The noun with its indefinite article, chosen by its first letter, which is right for all words of the format.
inline std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && std::string_view("aeio").find(noun.front()) != std::string_view::npos;
  return std::string(vowel ? "an " : "a ") + std::string(noun);
}

}  // namespace pintle
