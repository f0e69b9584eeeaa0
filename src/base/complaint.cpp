#include "pintle/complaint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/text/utf8.h"

namespace pintle {
namespace {

constexpr std::size_t kWidest = 110;  // most characters of a source line that are shown

std::string heading(const Complaint& complaint) {
  const Place& place = complaint.place;
  std::string text = place.file;
  if (place.line > 0) {
    text += fmt::format("{}{}", text.empty() ? "line " : ":", place.line);
    if (place.column > 0) text += fmt::format(":{}", place.column);
  }
  if (!text.empty() && !complaint.path.empty()) text += ": ";
  return printable(text + complaint.path);
}

std::string with_full_stop(std::string text) {
  if (!text.empty() && std::string_view(".!?").find(text.back()) == std::string_view::npos) text += '.';
  return text;
}

std::string reason(const Complaint& complaint) {
  std::string text = complaint.found.empty() ? "" : "found " + complaint.found;
  if (!text.empty() && !complaint.because.empty()) text += ": ";
  return printable(with_full_stop(text + complaint.because));
}

std::size_t bytes_of(std::string_view text, std::size_t n_characters) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < n_characters && at < text.size(); ++i) at += character_at(text, at).size();
  return at;
}

// The line with a mark in front and a caret below it; a very long line is cut to a window around the caret.
std::string source_with_caret(const Complaint& complaint) {
  std::string line = printable(complaint.source_line);
  std::size_t before = complaint.place.column > 0 ? static_cast<std::size_t>(complaint.place.column - 1) : 0;
  if (count_characters(line) > kWidest) {
    const std::size_t skipped = before > kWidest / 2 ? before - kWidest / 2 : 0;
    line = line.substr(bytes_of(line, skipped));
    line = line.substr(0, bytes_of(line, kWidest));
    before -= skipped;
  }
  const std::string margin = fmt::format("  > {} | ", complaint.place.line);
  std::string text = margin + line;
  if (complaint.place.column <= 0) return text;
  std::string padding(margin.size(), ' ');
  for (std::size_t i = 0, at = 0; i < std::min(before, kWidest); ++i) {
    const std::string_view character = character_at(line, at);
    padding += character == "\t" ? '\t' : ' ';
    at += character.size();
  }
  return text + '\n' + padding + '^';
}

std::string all_as_text(const std::vector<Complaint>& complaints) {
  std::string text;
  for (const Complaint& complaint : complaints) {
    if (!text.empty()) text += '\n';
    text += to_text(complaint);
  }
  return text;
}

}  // namespace

std::string to_text(const Complaint& complaint) {
  std::string text = heading(complaint);
  const auto append = [&](const std::string& line) {
    if (line.empty()) return;
    if (!text.empty()) text += '\n';
    text += line;
  };
  const std::string why = reason(complaint);
  if (!why.empty()) append("    " + why);
  if (!complaint.suggestion.empty()) append("    try: " + printable(complaint.suggestion));
  if (!complaint.source_line.empty() && complaint.place.line > 0) append(source_with_caret(complaint));
  return text;
}

InputError::InputError(std::vector<Complaint> complaints)
    : std::runtime_error(all_as_text(complaints)), complaints_(std::move(complaints)) {}

}  // namespace pintle
