// A run that keeps less than `simulate` does, for those who make many of them.
#pragma once

#include "analyses/recorder.h"
#include "pintle/simulate.h"

namespace pintle {

struct RunShape {
  Recorded recorded = Recorded::kColumns;
  bool checked = true;  ///< integrated until the error estimates meet the tolerance; otherwise once, and nothing is estimated
};

/// `simulate`, bit for bit, as far as it goes.
Trajectory lean_run(const Model& model, const RunShape& shape, const Observer& observer = {});

}  // namespace pintle
