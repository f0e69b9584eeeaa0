// The messages about text that cannot be read as an expression.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/expression/expression_dimensions.h"
#include "base/expression/expression_parser.h"
#include "base/unit_scanner.h"

namespace pintle {

/// The text goes on at `at` where it should end, or where an operator or a closing parenthesis should be.
ParseProblem unexpected_after_operand(std::string_view text, std::size_t at, const ParseScope& scope);

/// A number, a name or a parenthesis should be at `at`.
ParseProblem no_operand(std::string_view text, std::size_t at);

/// The word at `at` is no name of this scope.
ParseProblem unknown_name(std::string_view word, std::size_t at, const ParseScope& scope);

/// The word at `at` stands where a unit should be and is none.
ParseProblem unknown_unit(std::string_view word, std::size_t at);
/// `parameter`: the symbol that could be a parameter as well, or nothing.
ParseProblem faulty_unit(const UnitScan& scan, std::string_view parameter);

/// The table that is called by this word, or null.
const ParseScope::Table* find_table(std::string_view word, const ParseScope& scope);

/// Why a table does not take this argument; "" if it does.
DimensionProblem check_argument(const Operand& argument, const ParseScope::Table& table);

/// Is the word a variable, a constant, a function or a table here?
bool is_known_name(std::string_view word, const ParseScope& scope);

}  // namespace pintle
