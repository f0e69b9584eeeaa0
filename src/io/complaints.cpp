#include "io/complaints.h"

#include <algorithm>
#include <tuple>

#include "base/text/did_you_mean.h"
#include "io/text.h"

namespace pintle {

void Complaints::add(Spot spot, std::string path, std::string found, std::string because, std::string suggestion) {
  complaints_.emplace_back(
      spot, document_.complaint(spot, std::move(path), std::move(found), std::move(because), std::move(suggestion)));
}

std::string Complaints::nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (suggestions_left_ <= 0) return {};
  --suggestions_left_;
  return pintle::did_you_mean(word, candidates).value_or("");
}

std::string Complaints::did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  return advice(nearest(word, candidates), candidates);
}

std::string advice(const std::string& near, const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 16;
  if (!near.empty()) return "did you mean " + in_quotes(near) + "?";
  std::string list;
  std::size_t n_shown = 0;
  for (const std::string& name : names) {
    if (name == "*" || ++n_shown > kShown) continue;
    list += (list.empty() ? "one of " : ", ") + name;
  }
  return list + (n_shown > kShown ? ", ..." : "");
}

void Complaints::throw_if_any() {
  if (complaints_.empty()) return;
  std::stable_sort(complaints_.begin(), complaints_.end(), [](const auto& a, const auto& b) {
    const auto key = [](const Spot& spot) { return std::tuple(spot.source, spot.line, spot.column); };
    return key(a.first) < key(b.first);
  });
  std::vector<Complaint> all;
  for (auto& [spot, complaint] : complaints_) all.push_back(std::move(complaint));
  throw InputError(std::move(all));
}

}  // namespace pintle
