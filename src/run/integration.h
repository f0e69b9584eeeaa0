// One integration from the start to the end, recorded at the output times.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "integrators/methods.h"
#include "run/energy_watch.h"
#include "run/errors/ringing_loss.h"
#include "run/errors/suppressed_instability.h"
#include "run/record/force_recorder.h"

namespace pintle {

template <class S>
struct BasicIntegrationPlan {
  double duration = 0;
  double output_step = 0;
  double max_step = 0;
  double tolerance = 1e-5;           // of the stepper
  double first_step = 0;
  MethodChoice choice;
  const BasicLoadScale<S>* scale = nullptr;  // from an earlier pass
  BasicEnergyWatch<S>* energy = nullptr;     // ends the integration if it raises an alarm
  BasicRingingLoss<S>* ringing = nullptr;    // sees the steps of methods that keep their stages
  BasicSuppressedInstability<S>* instability = nullptr;  // sees these steps, too
  std::function<bool(double t)> keep_going;  // called after each step; false stops
};
using IntegrationPlan = BasicIntegrationPlan<Planar>;

enum class Ended { kAtEnd, kStopped, kFailed, kRunaway, kEnergyOpen };

template <class S>
struct BasicIntegration {
  Ended ended = Ended::kAtEnd;
  double t = 0;
  std::string message;
  Counters counters;
  BasicLoadScale<S> scale;
  std::vector<LawCrossing> crossings;  // of the borders of laws
  std::vector<std::string> remarks;  // of the method, for the notes
  int sliding_load = -1;                // Stepper::sliding_load
  double largest_step_error = 1;        // Stepper::largest_step_error
  double unbounded_reactions = -1;   // Stepper::unbounded_reactions
};
using Integration = BasicIntegration<Planar>;

/// Integrates by the plan's method; rows go to `recorder`.
template <class S>
BasicIntegration<S> integrate(const BasicSystem<S>& system, const BasicState<S>& start, const BasicIntegrationPlan<S>& plan, BasicForceRecorder<S>& recorder);

}  // namespace pintle
