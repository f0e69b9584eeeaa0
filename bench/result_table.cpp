#include "bench/result_table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "results/text_table.h"

namespace pintle::bench {

Cell text(std::string words) {
  return {words, words};
}

Cell number(double value, const char* format) {
  if (!std::isfinite(value)) return {"-", nullptr};
  return {fmt::format(fmt::runtime(format), value), value};
}

Cell count(double value) {
  return number(value, "{:.0f}");
}

ResultTable::ResultTable(std::string title, std::vector<Column> columns)
    : title_(std::move(title)), columns_(std::move(columns)) {}

void ResultTable::add_row(std::vector<Cell> cells) {
  rows_.push_back(std::move(cells));
}

void ResultTable::print() const {
  TextTable table;
  for (const Column& column : columns_)
    table.add_column(column.head, column.is_text ? TextTable::Align::kLeft : TextTable::Align::kNumber);
  for (const auto& row : rows_) {
    std::vector<std::string> cells;
    for (const Cell& cell : row) cells.push_back(cell.text);
    table.add_row(std::move(cells));
  }
  fmt::print("\n{}\n{}", title_, table.text());
  std::fflush(stdout);
}

std::string ResultTable::markdown() const {
  std::string out = "|", rule = "|";
  for (const Column& column : columns_) {
    out += fmt::format(" {} |", column.head);
    rule += column.is_text ? " --- |" : " ---: |";
  }
  out += "\n" + rule + "\n";
  for (const auto& row : rows_) {
    out += "|";
    for (const Cell& cell : row) out += fmt::format(" {} |", cell.text);
    out += "\n";
  }
  return out;
}

nlohmann::ordered_json ResultTable::json() const {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : rows_) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i) object[columns_[i].key] = row[i].value;
    rows.push_back(std::move(object));
  }
  return rows;
}

}  // namespace pintle::bench
