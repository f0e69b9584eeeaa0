// Pintle's own integrator on the problem that the peers solve, and one turn as in a complete run.
#pragma once

#include "bench/problem.h"
#include "integrators/methods.h"
#include "pintle/model.h"
#include "start/start.h"

namespace pintle::bench {

struct PintleRun {
  bool completed = false;
  double seconds = 0;
  Counters counters;
  LoadScale scale;
  Samples samples;
  /// Without the data that only Pintle provides.
  MethodRun measured() const;
};

/// The stepper alone, with dense output; `scale` comes from an earlier integration, if any.
PintleRun run_stepper(const Problem& problem, const MethodChoice& choice, double tolerance, const LoadScale* scale = nullptr);
/// The same, with the force-accurate method.
PintleRun run_radau(const Problem& problem, int stages, double tolerance, const LoadScale* scale = nullptr);

/// The two integrations of a run whose first estimate is good enough: the pilot and the reported one.
struct RunPasses {
  PintleRun pilot, reported;
};
RunPasses run_passes(const Problem& problem, double tolerance);

/// A model ready to run, with its start state. It must not be moved (problems point into it).
struct ReadyModel {
  explicit ReadyModel(Model from);
  ReadyModel(const ReadyModel&) = delete;
  ReadyModel& operator=(const ReadyModel&) = delete;

  const Model model;
  const Assembly assembly;
  const System& system = assembly.system;
  const State& start = assembly.state;
  Problem problem(int outputs) const;
  /// The marker "body.marker".
  FollowedPoint point(const MarkerRef& marker) const;
};

/// Everything that `simulate` does, from the model to the table of results; it ends at the problem's cap.
MethodRun whole_run(const ReadyModel& ready, const Problem& problem, double tolerance);

/// mechanisms/<name>.toml with overrides.
Model collection_model(const std::string& name, const std::vector<std::string>& overrides = {});

}  // namespace pintle::bench
