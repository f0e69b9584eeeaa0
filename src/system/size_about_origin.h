// A mechanism's size as accuracies need it: positions are rounded relative to their distance from the origin.
#pragma once

#include <algorithm>

#include "system/state.h"

namespace pintle {

/// The largest coordinate of a body, or the largest radius of gyration if that is more [m].
template <class S>
double size_about_origin(const BasicSystem<S>& system, const PositionsOf<S>& q) {
  return std::max(largest_coordinate(q), system.largest_radius_of_gyration());
}

}  // namespace pintle
