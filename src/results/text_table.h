// Tables of text and numbers for the console: columns are aligned, numbers at their decimal points.
#pragma once

#include <string>
#include <vector>

namespace pintle {

/// `x` with five significant digits, as engineers write it: fixed from 0.001 to a million, else with an exponent; "-" for NaN.
std::string engineering(double x);

/// Two significant digits with an exponent, for error estimates; "-" for NaN.
std::string exponent(double x);

class TextTable {
 public:
  enum class Align { kLeft, kNumber };

  /// The header shows `unit` in brackets; empty: none.
  void add_column(std::string head, Align align, const std::string& unit = "");
  void add_row(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }

  /// The table indented by two spaces, with its header between `bold` and `plain`.
  std::string text(const std::string& bold = "", const std::string& plain = "") const;

 private:
  struct TableColumn {
    std::string head;
    Align align;
  };
  std::vector<std::string> padded_cells(std::size_t column) const;

  std::vector<TableColumn> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace pintle
