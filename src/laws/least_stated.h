// The value that a model states for a key of a law, and the law's default if nothing is stated.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "laws/catalog.h"
#include "pintle/model.h"

namespace pintle {

/// The smallest of the values stated under `key` [SI]; none if nothing is stated.
inline std::optional<double> least_stated(const LawChoice& law, const std::string& key) {
  const auto found = law.values.find(key);
  if (found == law.values.end() || found->second.empty()) return std::nullopt;
  return *std::min_element(found->second.begin(), found->second.end());
}

/// The same; if nothing is stated, the default of the law's catalog entry. 0 for a key that the law does not have.
inline double least_value(const LawChoice& law, const std::string& key) {
  if (const auto stated = least_stated(law, key)) return *stated;
  const LawInfo* known = find_law(law.word);
  const KeyInfo* info = known ? find_key(known->keys, key) : nullptr;
  return info ? info->fallback : 0;
}

}  // namespace pintle
