// The word that a misspelt one probably meant.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (each letter is touched
/// once: the restricted Damerau-Levenshtein distance).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The closest of `words`, if it is close enough to be a slip of the pen: about one edit in three letters, or `word` is its
/// beginning or the last of its words (`length` of `free_length`). Case hardly counts. Of equally close words the first is taken.
std::optional<std::string> did_you_mean(std::string_view word, std::span<const std::string_view> words);

/// The same for any range of strings.
template <class Words>
std::optional<std::string> did_you_mean(std::string_view word, const Words& words) {
  const std::vector<std::string_view> views(std::begin(words), std::end(words));
  return did_you_mean(word, std::span<const std::string_view>(views));
}

}  // namespace pintle
