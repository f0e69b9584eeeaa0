#include "base/text/name_patterns.h"

#include <algorithm>

namespace pintle {

// Whenever the rest does not match, the last * found takes one more letter.
bool matches_pattern(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

NamePatterns::NamePatterns(const std::vector<std::string>& entries) {
  for (const std::string& entry : entries) {
    if (entry.find('*') == std::string::npos) names_.insert(entry);
    else wild_.push_back(entry);
  }
}

bool NamePatterns::match(const std::string& name) const {
  return names_.contains(name) ||
         std::any_of(wild_.begin(), wild_.end(), [&name](const std::string& pattern) { return matches_pattern(pattern, name); });
}

}  // namespace pintle
