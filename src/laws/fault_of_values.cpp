#include "laws/fault_of_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/text/did_you_mean.h"

namespace pintle {
namespace {

std::string fault_of(const KeyInfo& key, const std::vector<double>& values) {
  if (values.empty() || (values.size() > 1 && !key.list && !key.per_component)) return fmt::format("{} is one number, not {}", key.key, values.size());
  for (const double x : values) {
    if (std::isnan(x)) return fmt::format("{} is not a number", key.key);
    if (key.minimum_exclusive ? x <= key.minimum : x < key.minimum) return fmt::format("{} = {:g} must be {} {:g}", key.key, x, key.minimum_exclusive ? "greater than" : "at least", key.minimum);
  }
  return {};
}

// Where a program switches a joint's law, the previous law's values may stay, as they may in files.
bool is_of_another_law(std::string_view key) {
  const auto laws = law_catalog();
  return std::any_of(laws.begin(), laws.end(), [key](const LawInfo& law) { return find_key(law.keys, key) != nullptr; });
}

}  // namespace

std::string fault_of_values(const LawInfo& law, const std::map<std::string, std::vector<double>>& values) {
  std::vector<std::string_view> known;
  for (const KeyInfo& key : law.keys) known.push_back(key.key);
  for (const auto& [word, numbers] : values) {
    const KeyInfo* key = find_key(law.keys, word);
    if (key == nullptr && is_of_another_law(word)) continue;
    if (key == nullptr) {
      const auto meant = did_you_mean(word, known);
      return fmt::format("'{}' has no key '{}'{}", law.word, word, meant ? fmt::format("; did you mean '{}'?", *meant) : std::string());
    }
    if (const std::string fault = fault_of(*key, numbers); !fault.empty()) return fault;
  }
  for (const KeyInfo& key : law.keys)
    if (key.required && !values.contains(std::string(key.key))) return fmt::format("'{}' needs the key '{}'", law.word, key.key);
  return {};
}

}  // namespace pintle
