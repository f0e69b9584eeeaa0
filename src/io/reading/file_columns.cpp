#include "io/reading/file_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/decimal.h"
#include "base/text/csv_fields.h"
#include "base/text/did_you_mean.h"
#include "base/units.h"
#include "io/text.h"

namespace pintle {
namespace {

struct Row {
  std::size_t line = 0;
  std::vector<std::string> cells;
};

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string() : std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::optional<double> number_in(const std::string& cell) {
  const Decimal read = read_decimal(cell);
  return read.whole && read.in_range && std::isfinite(read.value) ? std::optional(read.value) : std::nullopt;
}

bool is_comment(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos || line[line.find_first_not_of(" \t")] == '#'; }

// A semicolon or a tab if the first line of the table has one.
char separator_of(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (!is_comment(line)) return line.find(';') != std::string_view::npos ? ';' : line.find('\t') != std::string_view::npos ? '\t' : ',';
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return ',';
}

std::vector<Row> rows_of(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<Row> rows;
  CsvFields fields(text, separator_of(text));
  while (!fields.at_end()) {
    Row row;
    do {
      row.cells.push_back(trimmed(fields.next()));
      if (row.cells.size() == 1) row.line = fields.line();
    } while (!fields.row_done());
    const bool blank = std::all_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) { return cell.empty(); });
    if (!blank && !row.cells.front().starts_with('#')) rows.push_back(std::move(row));
  }
  return rows;
}

// "force [N]": the name and the unit.
struct Heading {
  std::string name;
  std::optional<std::string> unit;
};
Heading heading_of(const std::string& cell) {
  const std::size_t open = cell.rfind('[');
  if (open == std::string::npos || !cell.ends_with(']')) return {cell, {}};
  const std::string unit = trimmed(std::string_view(cell).substr(open + 1, cell.size() - open - 2));
  return {trimmed(std::string_view(cell).substr(0, open)), parse_unit(unit) ? std::optional(unit) : std::nullopt};
}

class ColumnReader {
 public:
  ColumnReader(const std::string& file, std::string_view text, const std::array<ColumnChoice, 2>& choices) : file_(file), rows_(rows_of(text)) {
    if (rows_.empty()) throw FileFault{-1, in_quotes(file), "there are no numbers in it", "columns of numbers"};
    for (const std::size_t which : {0U, 1U}) places_[which] = place_of(static_cast<int>(which), choices[which]);
    const auto is_number = [this](std::size_t row, std::size_t place) { return place < rows_[row].cells.size() && number_in(rows_[row].cells[place]); };
    const auto is_unit = [this](std::size_t place) { return place < rows_[1].cells.size() && parse_unit(rows_[1].cells[place]); };
    const bool named = !choices[0].name.empty() || !choices[1].name.empty() || !is_number(0, places_[0]) || !is_number(0, places_[1]);
    const bool with_units = named && rows_.size() > 1 && !is_number(1, places_[0]) && !is_number(1, places_[1]) && is_unit(places_[0]) && is_unit(places_[1]);
    first_number_ = with_units ? 2 : named ? 1 : 0;
  }

  FileColumns columns() const {
    FileColumns out;
    for (const std::size_t which : {0U, 1U}) out.columns[which] = column_at(places_[which]);
    for (std::size_t i = first_number_; i < rows_.size(); ++i) out.lines.push_back(rows_[i].line);
    return out;
  }

 private:
  std::size_t place_of(int which, const ColumnChoice& choice) const {
    const std::vector<std::string>& first = rows_.front().cells;
    if (choice.name.empty()) {
      if (choice.number >= 1 && choice.number <= first.size()) return choice.number - 1;
      throw FileFault{which, fmt::format("column {}", choice.number), fmt::format("{} has {} {}", file_, first.size(), first.size() == 1 ? "column" : "columns"), fmt::format("1 to {}, or a name of its first row", first.size())};
    }
    std::vector<std::string> names;
    for (const std::string& cell : first) names.push_back(heading_of(cell).name);
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] == choice.name || names[i] == choice.name) return i;
    if (std::all_of(first.begin(), first.end(), [](const std::string& cell) { return number_in(cell).has_value(); }))
      throw FileFault{which, in_quotes(choice.name), fmt::format("{} has no names: its first row is of numbers", file_), "the number of the column, counted from 1"};
    const auto near = did_you_mean(choice.name, names);
    throw FileFault{which, in_quotes(choice.name), fmt::format("{} has no such column", file_), near ? "did you mean " + in_quotes(*near) + "?" : fmt::format("one of {}", fmt::join(names, ", "))};
  }

  FileColumn column_at(std::size_t place) const {
    FileColumn out;
    if (first_number_ > 0) out.unit = heading_of(rows_.front().cells[place]).unit;
    if (first_number_ > 1 && place < rows_[1].cells.size()) out.unit = rows_[1].cells[place];
    for (std::size_t i = first_number_; i < rows_.size(); ++i) out.numbers.push_back(number_at(rows_[i], place));
    return out;
  }

  double number_at(const Row& row, std::size_t place) const {
    if (place >= row.cells.size()) throw FileFault{-1, fmt::format("{}:{}", file_, row.line), fmt::format("this line has no column {}", place + 1), "as many fields as in the first row"};
    const std::string& cell = row.cells[place];
    if (const auto number = number_in(cell)) return *number;
    throw FileFault{-1, fmt::format("{}:{}: {}", file_, row.line, in_quotes(cell)), "it is not a number", cell.find(',') == std::string::npos ? "a number, without a unit" : "decimals with a point"};
  }

  const std::string& file_;
  std::vector<Row> rows_;
  std::array<std::size_t, 2> places_{};
  std::size_t first_number_ = 0;  // the first row that is not a header
};

}  // namespace

FileColumns read_file_columns(const std::string& file, std::string_view text, const std::array<ColumnChoice, 2>& choices) {
  try {
    return ColumnReader(file, text, choices).columns();
  } catch (const CsvFault& fault) {
    throw FileFault{-1, fmt::format("{}:{}: {}", file, fault.line, fault.found), fault.because, "a table as in RFC 4180"};
  }
}

}  // namespace pintle
