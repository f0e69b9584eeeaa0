// summary.json: everything about a run except the values of its columns.
#pragma once

#include <filesystem>
#include <string_view>

#include "pintle/results.h"

namespace pintle {

/// A run together with the number of rows that summary.json promises for series.csv.
struct Summary {
  RunRecord run;  ///< without values
  std::size_t n_rows = 0;
};

/// Throws FileError, with the position in `path`, if `text` is not a summary written by this program.
Summary parse_summary(std::string_view text, const std::filesystem::path& path);

/// Whether `text` is a summary of this program, of any version.
bool is_summary(std::string_view text);

}  // namespace pintle
