#include "base/text/did_you_mean.h"

#include <algorithm>

namespace pintle {
namespace {

constexpr std::size_t kLongest = 64;  // bytes; longer words are not slips of the pen

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::size_t largest_slip(std::size_t length) {
  return std::max<std::size_t>(1, length / 3);
}

// Ten times the distance ignoring case, plus one if the first letters differ, if only in case; a prefix, or the last of several words, counts as one slip.
std::optional<std::size_t> cost(std::string_view word, std::string_view candidate) {
  if (candidate.empty() || candidate.size() > kLongest) return std::nullopt;
  const std::string a = lower_case(word);
  const std::string b = lower_case(candidate);
  std::size_t distance = edit_distance(a, b);
  const bool is_slip =
      distance <= largest_slip(std::max(a.size(), b.size())) && distance < std::min(a.size(), b.size());
  const bool is_part = a.size() >= 3 && (b.starts_with(a) || b.ends_with("_" + a));
  if (distance != 0 && !is_slip && !is_part) return std::nullopt;
  if (!is_slip && is_part) distance = std::min(distance, largest_slip(b.size()));
  return 10 * distance + (word.front() == candidate.front() ? 0 : 1);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> did_you_mean(std::string_view word, std::span<const std::string_view> words) {
  if (word.empty() || word.size() > kLongest) return std::nullopt;
  if (word.ends_with("ies")) {
    std::string singular(word.substr(0, word.size() - 2));
    singular.back() = 'y';
    if (std::find(words.begin(), words.end(), singular) != words.end()) return singular;
  }
  std::optional<std::string> best;
  std::size_t best_cost = 0;
  for (const std::string_view candidate : words) {
    const std::optional<std::size_t> found = cost(word, candidate);
    if (!found || (best && *found >= best_cost)) continue;
    best = std::string(candidate);
    best_cost = *found;
  }
  return best;
}

}  // namespace pintle
