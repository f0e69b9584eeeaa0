// A table of results, printed for people and written as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pintle::bench {

/// One cell: the printed text, and the value behind it.
struct Cell {
  std::string text;
  nlohmann::ordered_json value;
};

Cell text(std::string words);
/// `format` is fmt's for a double, e.g. "{:.2e}"; NaN prints as "-".
Cell number(double value, const char* format);
Cell count(double value);

class ResultTable {
 public:
  struct Column {
    std::string head;  // printed
    std::string key;   // in JSON
    bool is_text = false;
  };
  ResultTable(std::string title, std::vector<Column> columns);

  void add_row(std::vector<Cell> cells);
  bool empty() const { return rows_.empty(); }
  std::size_t n_columns() const { return columns_.size(); }
  const std::string& title() const { return title_; }
  void print() const;
  /// The rows as a Markdown table, without the title.
  std::string markdown() const;
  /// An array with one object per row.
  nlohmann::ordered_json json() const;

 private:
  std::string title_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace pintle::bench
