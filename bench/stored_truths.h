// The truths of compliant mechanisms that are too large to be recomputed in every benchmark: bench/truths/<problem>.json.
#pragma once

#include <optional>
#include <string>

#include "bench/problem.h"

namespace pintle::bench {

struct StoredTruth {
  std::string method;      // how it was computed
  double place_doubt = 0;  // difference from the run with a tolerance ten times as large [m]
  Samples places;          // no forces
};

/// Empty if there is no file, or if it has other output times or another start.
std::optional<StoredTruth> read_truth(const std::string& name, const Problem& problem);
void write_truth(const std::string& name, const Problem& problem, const StoredTruth& truth);

}  // namespace pintle::bench
