#include "base/text/csv_fields.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pintle {

std::string CsvFields::next() {
  row_done_ = false;
  field_line_ = line_;
  field_column_ = column_;
  std::string field = !rest_.empty() && rest_.front() == '"' ? take_quoted() : take_plain();
  finish_field();
  return field;
}

void CsvFields::fail(std::string found, std::string because) const { throw CsvFault{field_line_, field_column_, std::move(found), std::move(because)}; }

std::string CsvFields::take_plain() {
  const std::array<char, 3> ends{separator_, '\r', '\n'};
  const std::size_t n = std::min(rest_.find_first_of(std::string_view(ends.data(), ends.size())), rest_.size());
  std::string field(rest_.substr(0, n));
  drop(n);
  return field;
}

std::string CsvFields::take_quoted() {
  std::string field;
  drop(1);
  while (!rest_.empty()) {
    const char c = rest_.front();
    drop(1);
    if (c == '\n') next_line();
    if (c != '"') {
      field += c;
    } else if (!rest_.empty() && rest_.front() == '"') {
      field += '"';
      drop(1);
    } else {
      return field;
    }
  }
  fail("a quote", "it is never closed");
}

void CsvFields::finish_field() {
  if (!rest_.empty() && rest_.front() == separator_) return drop(1);
  if (rest_.substr(0, 2) == "\r\n") drop(1);
  if (!rest_.empty() && rest_.front() != '\n') fail("text after a quoted field", "expected a separator or the end of the line");
  if (!rest_.empty()) drop(1);
  next_line();
  row_done_ = true;
}

void CsvFields::drop(std::size_t n) {
  rest_.remove_prefix(n);
  column_ += n;
}

void CsvFields::next_line() {
  ++line_;
  column_ = 1;
}

}  // namespace pintle
