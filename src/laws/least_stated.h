// What a model states of a law, by key.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "pintle/model.h"

namespace pintle {

/// The least of the numbers that are stated under `key` [SI]; none where nothing is.
inline std::optional<double> least_stated(const LawChoice& law, const std::string& key) {
  const auto found = law.values.find(key);
  if (found == law.values.end() || found->second.empty()) return std::nullopt;
  return *std::min_element(found->second.begin(), found->second.end());
}

}  // namespace pintle
