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
  /// Of time over loops: the slope of the line through the logarithms.
  double exponent() const;
  ResultTable table() const;
};

/// N four-bars over `duration`, before they first come in line, at one tolerance. Every size has its turn in every round, small ones
/// with as many runs as are worth a median; the medians of all runs.
Scaling measure_scaling(const std::vector<int>& loops, int rounds, double duration = 0.3, double tolerance = 1e-4);

}  // namespace pintle::bench
