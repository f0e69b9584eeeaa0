// Any law of the catalog, by value.
#pragma once

#include <variant>

#include "laws/linear.h"
#include "laws/tension.h"

namespace pintle {

using Law = std::variant<LinearLaw, TensionLaw>;

inline Planar::Vec law_force(const Law& law, const Planar::Vec& gap, const Planar::Vec& rate) {
  return std::visit([&](const auto& l) { return l.force(gap, rate); }, law);
}
inline Response respond(const Law& law, const Planar::Vec& gap, const Planar::Vec& rate) {
  return std::visit([&](const auto& l) { return l.respond(gap, rate); }, law);
}

/// The power that is lost [W].
inline double law_loss(const Law& law, const Planar::Vec& gap, const Planar::Vec& rate) {
  return std::visit([&](const auto& l) { return l.loss(gap, rate); }, law);
}

/// Laws with kinks say which side of them they are on, so that integrators can stop there.
inline bool has_branches(const Law& law) {
  return std::visit([](const auto& l) { return l.kHasBranches; }, law);
}
inline unsigned branch(const Law& law, const Planar::Vec& gap, const Planar::Vec& rate) {
  return std::visit([&](const auto& l) { return l.branch(gap, rate); }, law);
}

}  // namespace pintle
