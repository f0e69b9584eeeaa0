// A run that records less than `simulate`, for callers that make many of them.
#pragma once

#include "integrators/load_scale.h"
#include "pintle/simulate.h"
#include "run/record/force_recorder.h"

namespace pintle {

/// How the last integration of a checked run was made, for runs of its like.
template <class S>
struct BasicNominalRun {
  double wanted = 0;     // tolerance of the forces
  double tolerance = 0;  // of the stepper that met it
  int stages = 0;
  double span = 0;       // over which joints are smooth at the start [s]; 0: not found
  BasicLoadScale<S> scale;
};
using NominalRun = BasicNominalRun<Planar>;

template <class S>
struct BasicRunShape {
  Recorded recorded = Recorded::kColumns;
  bool checked = true;  ///< integrated until the error estimates meet the tolerance; otherwise once, and nothing is estimated
  const BasicNominalRun<S>* nominal = nullptr;  ///< for a run that is not checked
  BasicNominalRun<S>* measured = nullptr;      ///< filled by a checked run, all but the span
};
using RunShape = BasicRunShape<Planar>;

/// The same numbers as `simulate`, as far as they are recorded.
Trajectory simulate_reduced(const Model& model, const RunShape& shape, const Observer& observer = {});

}  // namespace pintle
