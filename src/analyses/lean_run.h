// A run that records less than `simulate`, for callers that make many of them.
#pragma once

#include "analyses/recorder.h"
#include "integrators/load_scale.h"
#include "pintle/simulate.h"

namespace pintle {

/// How the last integration of a checked run was made, for runs of its like.
struct RunLesson {
  double wanted = 0;     // tolerance of the forces
  double tolerance = 0;  // of the stepper that met it
  int stages = 0;
  double span = 0;       // over which joints are smooth at the start [s]; 0: not found
  LoadScale scale;
};

struct RunShape {
  Recorded recorded = Recorded::kColumns;
  bool checked = true;  ///< integrated until the error estimates meet the tolerance; otherwise once, and nothing is estimated
  const RunLesson* lesson = nullptr;  ///< for a run that is not checked
  RunLesson* learned = nullptr;       ///< filled by one that is
};

/// `simulate`, bit for bit, as far as it goes.
Trajectory lean_run(const Model& model, const RunShape& shape, const Observer& observer = {});

}  // namespace pintle
