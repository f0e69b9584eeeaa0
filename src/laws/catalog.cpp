#include "laws/catalog.h"

#include <algorithm>
#include <array>

namespace pintle {
namespace {

constexpr std::array<KeyInfo, 4> kLinearKeys{{
    {.key = "stiffness", .unit = "N/m", .fallback = 1e8, .minimum_exclusive = true, .per_component = true,
     .meaning = "force per forbidden displacement"},
    {.key = "damping", .unit = "N*s/m", .fallback = 3e3, .per_component = true,
     .meaning = "force per rate of forbidden displacement"},
    {.key = "angular_stiffness", .unit = "N*m/rad", .fallback = 1e6, .minimum_exclusive = true,
     .meaning = "moment per forbidden rotation, for joints that forbid it"},
    {.key = "angular_damping", .unit = "N*m*s/rad", .fallback = 30,
     .meaning = "moment per rate of forbidden rotation"},
}};

constexpr std::array<LawInfo, 1> kLaws{{
    {.word = "linear", .meaning = "a spring and a damper in each forbidden displacement (the paper's axioms)", .keys = kLinearKeys},
}};

}  // namespace

std::span<const LawInfo> law_catalog() { return kLaws; }

const LawInfo* find_law(std::string_view word) {
  const auto it = std::find_if(kLaws.begin(), kLaws.end(), [&](const LawInfo& law) { return law.word == word; });
  return it == kLaws.end() ? nullptr : &*it;
}

}  // namespace pintle
