// Runs of the collection's mechanisms and of small models, for the tests of this room.
#pragma once

#include <string>

#include "pintle/read_model.h"
#include "pintle/results.h"
#include "pintle/simulate.h"
#include "results/disk.h"

namespace pintle::drawn {

struct DrawnRun {
  Model model;
  RunRecord run;
};

inline DrawnRun run_of(const std::string& toml, double duration = 0, double tolerance = 0) {
  DrawnRun drawn{parse_model(toml, "model.toml"), {}};
  if (duration > 0) drawn.model.simulate.duration = duration;
  if (tolerance > 0) drawn.model.simulate.tolerance = tolerance;
  drawn.run.trajectory = simulate(drawn.model);
  drawn.run.stamp = {drawn.model.name, "model.toml", "sha256:00", "0.1.0", "pintle run model.toml", {}, toml};
  return drawn;
}

/// A mechanism of the collection.
inline DrawnRun run_of_mechanism(const std::string& name) {
  return run_of(read_file(PINTLE_SOURCE_DIR "/mechanisms/" + name + ".toml"));
}

/// Its first `duration` [s], at a tolerance sufficient for pictures.
inline DrawnRun sketch_of_mechanism(const std::string& name, double duration) {
  return run_of(read_file(PINTLE_SOURCE_DIR "/mechanisms/" + name + ".toml"), duration, 1e-2);
}

}  // namespace pintle::drawn
