// Pintle's own integrator on the problem that the peers solve, and one turn as a run makes it.
#pragma once

#include "bench/force_samples.h"
#include "bench/sundials_methods.h"
#include "integrators/radau_stepper.h"
#include "pintle/model.h"

namespace pintle::bench {

struct PintleRun {
  bool completed = false;
  double seconds = 0;
  Counters counters;
  LoadScale scale;
  ForceSamples samples;
};

/// The stepper alone, with dense output; `scale` from an earlier integration, if any.
PintleRun run_radau(const Problem& problem, int stages, double tolerance, const LoadScale* scale = nullptr);

/// The two integrations that a run makes when its first estimate is good enough: the pilot and the reported one.
struct RunPasses {
  PintleRun pilot, reported;
};
RunPasses run_passes(const Problem& problem, double tolerance);

/// A model made ready: settled, with its start state. Not to be moved (problems point into it).
struct ReadyModel {
  explicit ReadyModel(Model from);
  ReadyModel(const ReadyModel&) = delete;
  ReadyModel& operator=(const ReadyModel&) = delete;

  Model model;
  System system;
  State start;
  Problem problem(int outputs) const;
};

/// mechanisms/<name>.toml with overrides.
Model collection_model(const std::string& name, const std::vector<std::string>& overrides = {});

}  // namespace pintle::bench
