// A run that records less than `simulate`, for callers that make many of them.
#pragma once

#include "integrators/load_scale.h"
#include "pintle/simulate.h"
#include "run/record/force_recorder.h"

namespace pintle {

/// How the last integration of a checked run was made, for similar runs.
template <class S>
struct BasicNominalRun {
  double wanted = 0;     // tolerance of the forces
  double tolerance = 0;  // of the stepper that met it
  int stages = 0;
  double span = 0;       // time over which joints are smooth at the start [s]; 0: not found
  BasicLoadScale<S> scale;
};
using NominalRun = BasicNominalRun<Planar>;

template <class S>
struct BasicRunShape {
  Recorded recorded = Recorded::kColumns;
  bool checked = true;  ///< integrated until the error estimates meet the tolerance; otherwise only once, without estimates
  const BasicNominalRun<S>* nominal = nullptr;  ///< for a run that is not checked
  BasicNominalRun<S>* measured = nullptr;      ///< filled in by a checked run, except for the span
};
using RunShape = BasicRunShape<Planar>;

/// Gives the same numbers as `simulate`, as far as they are recorded.
Trajectory simulate_reduced(const Model& model, const RunShape& shape, const Observer& observer = {});

}  // namespace pintle
