#include "results/series_csv.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/decimal.h"
#include "base/text/csv_fields.h"

namespace pintle {
namespace {

constexpr std::string_view kLineEnd = "\r\n";  // RFC 4180, section 2.1

std::string as_field(std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(field);
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

std::string header_row(const Trajectory& trajectory, std::string Column::*entry) {
  std::string row;
  for (const Column& column : trajectory.columns) {
    if (&column != trajectory.columns.data()) row += ',';
    row += as_field(column.*entry);
  }
  return row.append(kLineEnd);
}

std::optional<double> number(std::string_view field) {
  const Decimal read = read_decimal(field);
  return read.whole && read.in_range ? std::optional(read.value) : std::nullopt;
}

void read_columns(CsvFields& reader, Trajectory& trajectory) {
  trajectory.columns.clear();
  trajectory.values.clear();
  if (reader.at_end()) reader.fail("an empty file", "a header row of column names is expected");
  do {
    trajectory.columns.push_back({reader.next(), {}, {}});
  } while (!reader.row_done());
  const std::size_t n_columns = trajectory.columns.size();
  for (std::size_t row = 0; row == 0 || !reader.at_end(); ++row) {
    if (reader.at_end()) reader.fail("no second row", "a header row of units is expected");
    for (std::size_t i = 0; i < n_columns; ++i) {
      std::string field = reader.next();
      const std::optional<double> value = row == 0 ? 0 : number(field);
      if (!value) reader.fail(fmt::format("\"{}\"", field), "it is not a number");
      if (row == 0) trajectory.columns[i].unit = std::move(field);
      if (row > 0) trajectory.values.push_back(*value);
      if (reader.row_done() != (i + 1 == n_columns))
        reader.fail(fmt::format("{} {} fields", reader.row_done() ? "only" : "more than", i + 1),
                    fmt::format("the header row has {}", n_columns));
    }
  }
}

// For each column, the earlier one that it probably repeats but for the sign, such as the force on the other body, or in axes parallel to the world's; itself if none.
std::vector<std::size_t> repeated_columns(const Trajectory& trajectory) {
  std::vector<std::size_t> repeats(trajectory.columns.size());
  std::map<double, std::size_t> first;
  for (std::size_t j = 0; j < repeats.size(); ++j) {
    const double size = trajectory.n_rows() > 0 ? std::abs(trajectory.at(trajectory.n_rows() / 2, j)) : 0;
    repeats[j] = std::isfinite(size) ? first.emplace(size, j).first->second : j;
  }
  return repeats;
}

}  // namespace

void write_series(const Trajectory& trajectory, const std::function<void(std::string_view)>& append) {
  append(header_row(trajectory, &Column::name));
  append(header_row(trajectory, &Column::unit));
  std::string row;
  std::array<char, 32> number;  // a double needs at most 24 characters
  const std::size_t n_columns = trajectory.columns.size();
  const std::vector<std::size_t> repeats = repeated_columns(trajectory);
  struct Digits {
    std::size_t begin, size;  // within the row, without the sign
  };
  std::vector<Digits> digits(n_columns);
  for (std::size_t i = 0; i < trajectory.n_rows(); ++i) {
    row.clear();
    for (std::size_t j = 0; j < n_columns; ++j) {
      if (j > 0) row.push_back(',');
      const double value = trajectory.at(i, j);
      if (const std::size_t before = repeats[j]; before < j && std::abs(value) == std::abs(trajectory.at(i, before))) {
        if (std::signbit(value)) row.push_back('-');
        digits[j] = {row.size(), digits[before].size};
        row.append(row, digits[before].begin, digits[before].size);
        continue;
      }
      // Formatting directly into an array takes two thirds of the time of an appending iterator.
      const char* end = fmt::format_to(number.data(), FMT_COMPILE("{}"), value);
      const std::size_t sign = number[0] == '-' ? 1 : 0, size = static_cast<std::size_t>(end - number.data());
      digits[j] = {row.size() + sign, size - sign};
      row.append(number.data(), size);
    }
    row.append(kLineEnd);
    append(row);
  }
}

void read_series(std::string_view text, const std::filesystem::path& path, Trajectory& trajectory) {
  CsvFields reader(text);
  try {
    read_columns(reader, trajectory);
  } catch (const CsvFault& fault) {
    throw FileError(fmt::format("{}:{}:{}: series\n    found {}: {}.", path.string(), fault.line, fault.column, fault.found, fault.because));
  }
}

void write_events(const Trajectory& trajectory, const std::function<void(std::string_view)>& append) {
  std::vector<const Column*> reported;  // by any joint, each name once
  for (const JointEvents& joint : trajectory.events)
    for (const Column& column : joint.columns)
      if (std::none_of(reported.begin(), reported.end(), [&](const Column* one) { return one->name == column.name; })) reported.push_back(&column);
  std::string names = "t,joint,event", units = "s,,";
  for (const Column* column : reported) {
    names += ',' + as_field(column->name);
    units += ',' + as_field(column->unit);
  }
  append(names.append(kLineEnd).append(units).append(kLineEnd));
  for (const JointEvents& joint : trajectory.events)
    for (const JointEvent& event : joint.events) {
      std::string row = fmt::format("{},{},{}", event.t, as_field(joint.joint), as_field(event.what));
      for (const Column* column : reported) {
        row += ',';
        for (std::size_t k = 0; k < joint.columns.size() && k < event.values.size(); ++k)
          if (joint.columns[k].name == column->name) row += fmt::format("{}", event.values[k]);
      }
      append(row.append(kLineEnd));
    }
}

}  // namespace pintle
