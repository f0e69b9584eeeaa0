// A finished sweep for people, for programs, and as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pintle/sweep.h"
#include "results/plots/svg_plot.h"

namespace pintle {

/// Of the peak force of one joint over the samples that have one.
struct PeakStatistics {
  std::string joint;
  double least = 0, median = 0, high = 0, most = 0;  ///< high: 95 % of the samples have less [N]
  std::size_t least_sample = 0, most_sample = 0;
  double worst_error = 0;  ///< largest estimate over the joint's peak, or over 1e-4 of the sample's largest where that is more [-]; NaN where none was made
};
std::vector<PeakStatistics> peak_statistics(const SweepTable& table);

std::string sweep_text(const SweepTable& table, bool colour);
std::string sweep_json(const SweepTable& table, const std::string& file);

/// Peak forces against the value that varies; of two, one curve for each value of the one with fewer. Nothing for more than two.
std::optional<Plot> sweep_plot(const SweepTable& table);

}  // namespace pintle
