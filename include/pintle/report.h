// A run as one self-contained HTML page: moving mechanism, plots, tables. It needs no network and no file system.
#pragma once

#include <cstddef>
#include <string>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle {

struct ReportOptions {
  /// Limit on the numbers that the page holds for its pictures (eight bytes each, a third more as text). A longer run is
  /// thinned in time, and the page says so. The tables stay complete, and the instants of the largest joint forces are kept,
  /// which may add half as many rows again. A mechanism with very many columns keeps 50 rows, however many numbers that makes.
  std::size_t most_values = 750'000;
};

/// `model` is the model that was run. Throws std::invalid_argument for a model that is not planar.
std::string report_html(const Model& model, const RunRecord& run, const ReportOptions& options = {});

}  // namespace pintle
