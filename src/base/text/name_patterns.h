// Names selected by a list: each entry is a name, or contains a * for any letters.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace pintle {

/// Whether `name` matches `pattern`, in which each * stands for any number of letters, including none.
bool matches_pattern(std::string_view pattern, std::string_view name);

class NamePatterns {
 public:
  explicit NamePatterns(const std::vector<std::string>& entries);
  /// The cost grows with the number of entries that contain a *, not with that of the others.
  bool match(const std::string& name) const;

 private:
  std::unordered_set<std::string> names_;
  std::vector<std::string> wild_;
};

}  // namespace pintle
