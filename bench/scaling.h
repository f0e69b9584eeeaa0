// How time grows with the size of a mechanism.
#pragma once

#include <vector>

#include "bench/result_table.h"

namespace pintle::bench {

struct Scaling {
  struct Row {
    int loops = 0, bodies = 0;
    double steps = 0, iterations = 0, seconds = 0, spread = 0, start_seconds = 0;
    double per_body_and_step() const { return seconds / steps / bodies; }
  };
  std::vector<Row> rows;
  /// Exponent of time against loops: the slope of the line fitted to the logarithms.
  double exponent() const;
  ResultTable table() const;
};

/// N four-bars over `duration`, which ends before they first become collinear, at one tolerance. Every size is run in every round, small ones
/// often enough for a meaningful median; the medians are over all runs.
Scaling measure_scaling(const std::vector<int>& loops, int rounds, double duration = 0.3, double tolerance = 1e-4);

}  // namespace pintle::bench
