// Where a function of one variable has kinks and jumps, however short what is between them.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

/// Places next to each other on either side of where the switching function k changes its sign, which is another one at `low` than at `high`.
std::pair<double, double> bracket_switch(const Expression& f, std::size_t k, double low, double high);

/// All such places between two, ascending: those of tables exactly, up to `most` of each, and those of other switching functions that have another sign at the ends of one
/// of so many equal parts. The two sides of a short pulse are different functions, each with one place.
std::vector<double> switching_points(const Expression& f, double low, double high, int parts, std::size_t most);

}  // namespace pintle
