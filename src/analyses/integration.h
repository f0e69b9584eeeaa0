// One integration from the start to the end, recorded at the output times.
#pragma once

#include <functional>
#include <string>

#include "analyses/recorder.h"
#include "integrators/radau_stepper.h"

namespace pintle {

struct IntegrationPlan {
  double duration = 0;
  double output_step = 0;
  double max_step = 0;
  double tolerance = 1e-5;           // of the stepper
  double first_step = 0;
  int stages = 3;                    // of the implicit method, 3 or 5
  const LoadScale* scale = nullptr;  // from an earlier pass
  std::function<bool(double t)> keep_going;  // called after each step; false stops
};

enum class Ended { kAtEnd, kStopped, kFailed };

struct Integration {
  Ended ended = Ended::kAtEnd;
  double t = 0;
  std::string message;
  Counters counters;
  LoadScale scale;
};

/// Integrates with the force-accurate implicit method; rows go to `recorder`.
Integration integrate_radau(const System& system, const State& start, const IntegrationPlan& plan, Recorder& recorder);

/// The same with the explicit Dormand-Prince 5(4) pair on the equations as they stand.
Integration integrate_dopri5(const System& system, const State& start, const IntegrationPlan& plan, Recorder& recorder);

}  // namespace pintle
