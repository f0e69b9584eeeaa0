// Columns of numbers from a file of separated values that a table of the model names.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// Which column: by its name in the first row, or by its number, counted from 1.
struct ColumnChoice {
  std::string name;  ///< empty: choose by number
  std::size_t number = 0;
};

struct FileColumn {
  std::vector<double> numbers;
  std::optional<std::string> unit;  ///< as stated in the file's header
};

struct FileColumns {
  std::array<FileColumn, 2> columns;
  std::vector<std::size_t> lines;  ///< line of the file that each number is on
};

/// What is wrong with a file. Thrown.
struct FileFault {
  int column = -1;  ///< index of the choice that is wrong; -1: the file itself
  std::string found, because, suggestion;
};

/// The text is RFC 4180, or the same with semicolons or tabs instead of commas. Blank lines and lines that begin with # are skipped. The first row
/// may hold names, with or without units ("force [N]"), and the row below it units. `file` is for messages. Throws FileFault.
FileColumns read_file_columns(const std::string& file, std::string_view text, const std::array<ColumnChoice, 2>& choices);

}  // namespace pintle
