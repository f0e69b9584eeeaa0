// One integration from the start to the end, recorded at the output times.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "integrators/methods.h"
#include "run/energy_watch.h"
#include "run/recorder.h"

namespace pintle {

struct IntegrationPlan {
  double duration = 0;
  double output_step = 0;
  double max_step = 0;
  double tolerance = 1e-5;           // of the stepper
  double first_step = 0;
  MethodChoice choice;
  const LoadScale* scale = nullptr;  // from an earlier pass
  EnergyWatch* energy = nullptr;     // ends the integration where it raises an alarm
  std::function<bool(double t)> keep_going;  // called after each step; false stops
};

enum class Ended { kAtEnd, kStopped, kFailed, kRunaway, kEnergyOpen };

struct Integration {
  Ended ended = Ended::kAtEnd;
  double t = 0;
  std::string message;
  Counters counters;
  LoadScale scale;
  std::vector<LawCrossing> crossings;  // of the borders of laws
  std::vector<std::string> remarks;  // what the method noticed
};

/// Integrates by the plan's method; rows go to `recorder`.
Integration integrate(const System& system, const State& start, const IntegrationPlan& plan, Recorder& recorder);

}  // namespace pintle
