// summary.json: everything about a run but the values of its columns.
#pragma once

#include <filesystem>
#include <string_view>

#include "pintle/results.h"

namespace pintle {

/// The number of rows that summary.json promises for series.csv travels beside the run.
struct Summary {
  RunRecord run;  ///< without values
  std::size_t n_rows = 0;
};

/// Throws FileError, with the place in `path`, if `text` is not a summary that this program wrote.
Summary parse_summary(std::string_view text, const std::filesystem::path& path);

/// Whether `text` is a summary of this program, of whatever version.
bool is_summary(std::string_view text);

}  // namespace pintle
