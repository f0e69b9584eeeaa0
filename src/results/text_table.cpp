#include "results/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/utf8.h"

namespace pintle {
namespace {

std::string blanks(std::size_t n) {
  return std::string(n, ' ');
}

/// Position of the decimal point, or where it would be.
std::size_t point(const std::string& number) {
  return std::min(number.find_first_of(".e"), number.size());
}

}  // namespace

std::string engineering(double x) {
  const double size = std::abs(x);
  if (x == 0) return "0";
  if (std::isnan(x)) return "-";
  if (!std::isfinite(x)) return fmt::format("{}", x);
  if (size >= 999999.5 || size < 1e-3) return fmt::format("{:.4e}", x);
  const int digits_before = static_cast<int>(std::floor(std::log10(size))) + 1;
  return fmt::format("{:.{}f}", x, std::max(0, 5 - digits_before));
}

std::string exponent(double x) {
  if (std::isnan(x)) return "-";
  return x == 0 ? "0" : fmt::format("{:.1e}", x);
}

void TextTable::add_column(std::string head, Align align, const std::string& unit) {
  if (!unit.empty()) head += " [" + unit + "]";
  columns_.push_back({std::move(head), align});
}

void TextTable::add_row(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

std::vector<std::string> TextTable::padded_cells(std::size_t column) const {
  const TableColumn& about = columns_[column];
  std::vector<std::string> cells;
  for (const auto& row : rows_) cells.push_back(row[column]);
  std::size_t widest = count_characters(about.head);
  if (about.align == Align::kNumber) {
    std::size_t before = 0;
    for (const std::string& cell : cells) before = std::max(before, point(cell));
    for (std::string& cell : cells) cell.insert(0, blanks(before - point(cell)));
    std::size_t longest = 0;
    for (const std::string& cell : cells) longest = std::max(longest, count_characters(cell));
    for (std::string& cell : cells) cell += blanks(longest - count_characters(cell));
  }
  for (const std::string& cell : cells) widest = std::max(widest, count_characters(cell));
  cells.insert(cells.begin(), about.head);
  for (std::string& cell : cells) {
    const std::string padding = blanks(widest - count_characters(cell));
    cell = about.align == Align::kNumber ? padding + cell : cell + padding;
  }
  return cells;
}

std::string TextTable::text(const std::string& bold, const std::string& plain) const {
  std::vector<std::string> lines(rows_.size() + 1, " ");
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const std::vector<std::string> cells = padded_cells(column);
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] += (column == 0 ? " " : "   ") + cells[i];
  }
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    lines[i].erase(lines[i].find_last_not_of(' ') + 1);
    text += (i == 0 ? bold + lines[i] + plain : lines[i]) + "\n";
  }
  return text;
}

}  // namespace pintle
