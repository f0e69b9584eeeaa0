// Messages about text that cannot be read as an expression.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/expression/expression_dimensions.h"
#include "base/expression/expression_parser.h"
#include "base/unit_scanner.h"

namespace pintle {

/// The text continues at `at` where it should end, or where an operator or a closing parenthesis is expected.
ParseProblem unexpected_after_operand(std::string_view text, std::size_t at, const ParseScope& scope);

/// A number, a name or a parenthesis is expected at `at`.
ParseProblem no_operand(std::string_view text, std::size_t at);

/// The word at `at` is not a name of this scope.
ParseProblem unknown_name(std::string_view word, std::size_t at, const ParseScope& scope);

/// The word at `at` is in the place of a unit but is not one.
ParseProblem unknown_unit(std::string_view word, std::size_t at);
/// `parameter`: the symbol that could be a parameter too, or nothing.
ParseProblem faulty_unit(const UnitScan& scan, std::string_view parameter);

/// The table that is called by this word, or null.
const ParseScope::Table* find_table(std::string_view word, const ParseScope& scope);

/// Why a table does not accept this argument; "" if it does.
DimensionProblem check_argument(const Operand& argument, const ParseScope::Table& table);

/// Whether the word is a variable, a constant, a function or a table here.
bool is_known_name(std::string_view word, const ParseScope& scope);

}  // namespace pintle
