// A run as one self-contained HTML page: moving mechanism, plots, tables. It needs no network and no file system.
#pragma once

#include <cstddef>
#include <string>

#include "pintle/model.h"
#include "pintle/results.h"

namespace pintle {

struct ReportOptions {
  /// Numbers that the page should carry for its pictures (eight bytes each, a third more as text). A run with more is thinned
  /// in time, and the page says so. The tables stay, and the moments of the largest joint forces, which may be half as many
  /// rows again; a mechanism of very many columns keeps 50 rows, however many numbers that makes.
  std::size_t most_values = 750'000;
};

/// `model` is what was run. Throws std::invalid_argument for a model that is not planar.
std::string report_html(const Model& model, const RunRecord& run, const ReportOptions& options = {});

}  // namespace pintle
