// A run as one HTML page: moving mechanism, plots, tables. It needs nothing beside it, no network and no file system.
#pragma once

#include <cstddef>
#include <string>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle {

struct ReportOptions {
  /// Numbers that the page may carry for its pictures (eight bytes each, a third more as text). A run with more is thinned
  /// in time, and the page says so; the tables and the
  /// moments of the largest joint forces always stay.
  std::size_t most_values = 750'000;
};

/// `model` is what was run. Throws std::invalid_argument for a model that is not planar.
std::string report_html(const Model& model, const RunRecord& run, const ReportOptions& options = {});

}  // namespace pintle
