// The fields of a table of separated values, RFC 4180, one after the other.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pintle {

/// What is wrong with a table, and where. Thrown as an exception.
struct CsvFault {
  std::size_t line = 1, column = 1;
  std::string found, because;
};

/// Reads the fields in order and keeps track of its position.
class CsvFields {
 public:
  explicit CsvFields(std::string_view text, char separator = ',') : rest_(text), separator_(separator) {}

  bool at_end() const { return rest_.empty(); }
  /// The next field of this row; after the last field of the row `row_done()` is true. Throws CsvFault.
  std::string next();
  bool row_done() const { return row_done_; }
  /// Where the field returned by next() begins, counted from 1.
  std::size_t line() const { return field_line_; }
  std::size_t column() const { return field_column_; }
  /// Throws a fault at that field.
  [[noreturn]] void fail(std::string found, std::string because) const;

 private:
  std::string take_plain();
  std::string take_quoted();
  void finish_field();
  void drop(std::size_t n);
  void next_line();

  std::string_view rest_;
  char separator_;
  std::size_t line_ = 1, column_ = 1, field_line_ = 1, field_column_ = 1;
  bool row_done_ = false;
};

}  // namespace pintle
