// The words, numbers and operators of an expression, found at a byte offset of its text.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace pintle {

bool is_word_start(char c);
bool is_word_part(char c);
bool is_digit(char c);

/// First offset at or after `at` that is not a blank.
std::size_t skip_blanks(std::string_view text, std::size_t at);

/// The name at `at`: a letter or _, then letters, digits, _; empty if there is none.
std::string_view word_at(std::string_view text, std::size_t at);

/// The unit symbol at `at`: letters, the degree sign, or the micro sign before letters; empty if there is none.
std::string_view symbol_at(std::string_view text, std::size_t at);

/// The number at `at` as written ("2", ".5", "2e8", "1.5E-3"), without sign; empty if there is none.
std::string_view number_at(std::string_view text, std::size_t at);

/// Value of a text found by number_at, independent of the locale; infinity if it is too large.
double to_number(std::string_view number);

/// An operator and its length in bytes. The raised dot and the multiplication sign are '*', the minus sign is '-';
/// the comparisons <= and >= are 'l' and 'g'.
struct OperatorAt {
  char symbol = 0;
  std::size_t length = 0;
};
std::optional<OperatorAt> operator_at(std::string_view text, std::size_t at);

}  // namespace pintle
