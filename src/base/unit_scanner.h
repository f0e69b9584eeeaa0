// Finds the unit that follows a number, and where it ends.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "base/units.h"

namespace pintle {

/// Whether this word is a name of the expression's own.
using IsName = std::function<bool(std::string_view)>;
/// Whether this symbol after a unit could be meant as a name as well as as this unit.
using IsAmbiguous = std::function<bool(std::string_view, const Unit&)>;

/// The text at an offset: a unit up to `end`; no unit (`found` false, no `problem`); or a unit with a fault.
struct UnitScan {
  bool found = false;
  Unit unit;
  std::size_t end = 0;
  std::string problem;  ///< why it is wrong; empty if it is not
  std::size_t problem_offset = 0;
};

/// Reads symbol (('*' | '/') symbol)* with whole exponents, as far as units continue: in "10 N*sin(2*t)" it stops before the '*', as it does
/// in "3 m/2". A parenthesis counts if it contains nothing but units. A variable is never a unit. A parameter may have the symbol of a unit:
/// directly after a number the symbol is the unit; further on, as in "2 mm/h", it is a fault if it could be either.
UnitScan scan_unit(std::string_view text, std::size_t at, const IsName& is_variable, const IsAmbiguous& is_ambiguous);

}  // namespace pintle
