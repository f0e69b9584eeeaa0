// A finished sweep as text, as JSON, and as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pintle/sweep.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// Statistics of a joint's peak force over the samples that have one.
struct PeakStatistics {
  std::string joint;
  double least = 0, median = 0, high = 0, most = 0;  ///< high: exceeds 95 % of the samples [N]
  std::size_t least_sample = 0, most_sample = 0;
  double worst_error = 0;  ///< largest estimate relative to the joint's peak, or to 1e-4 of the sample's largest if that is more [-]; NaN if none was made
};
std::vector<PeakStatistics> peak_statistics(const SweepTable& table);

std::string sweep_text(const SweepTable& table, bool colour);
std::string sweep_json(const SweepTable& table, const std::string& file);

/// Peak forces against the varied value; if two values vary, one curve for each value of the one with fewer. Nothing for more than two.
std::optional<Plot> sweep_plot(const SweepTable& table);

}  // namespace pintle
