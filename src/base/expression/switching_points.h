// Kinks and jumps of a function of one variable, however short the intervals between them.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "pintle/expression.h"

namespace pintle {

/// Two adjacent places on either side of the sign change of switching function k, whose signs at `low` and `high` differ.
std::pair<double, double> bracket_switch(const Expression& f, std::size_t k, double low, double high);

/// All such places between two values, ascending: those of tables exactly, up to `most` for each, and those of other switching functions whose signs differ at the ends of
/// one of `parts` equal parts. The two sides of a short pulse are different functions with one place each.
std::vector<double> switching_points(const Expression& f, double low, double high, int parts, std::size_t most);

}  // namespace pintle
