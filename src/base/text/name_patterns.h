// Names chosen by a list: each entry is a name, or has a * for any letters.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace pintle {

/// Whether `name` is `pattern`, in which each * stands for any letters, or none.
bool matches_pattern(std::string_view pattern, std::string_view name);

class NamePatterns {
 public:
  explicit NamePatterns(const std::vector<std::string>& entries);
  /// The number of entries with a * counts in the cost, that of the others does not.
  bool match(const std::string& name) const;

 private:
  std::unordered_set<std::string> names_;
  std::vector<std::string> wild_;
};

}  // namespace pintle
