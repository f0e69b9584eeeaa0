// What a model states of a law, by key, and what the law takes where nothing is stated.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "laws/catalog.h"
#include "pintle/model.h"

namespace pintle {

/// The least of the numbers that are stated under `key` [SI]; none where nothing is.
inline std::optional<double> least_stated(const LawChoice& law, const std::string& key) {
  const auto found = law.values.find(key);
  if (found == law.values.end() || found->second.empty()) return std::nullopt;
  return *std::min_element(found->second.begin(), found->second.end());
}

/// The same; where nothing is stated, what the law's catalog entry takes. 0 of a key that the law does not have.
inline double least_value(const LawChoice& law, const std::string& key) {
  if (const auto stated = least_stated(law, key)) return *stated;
  const LawInfo* known = find_law(law.word);
  const KeyInfo* info = known ? find_key(known->keys, key) : nullptr;
  return info ? info->fallback : 0;
}

}  // namespace pintle
