// A run of a planar model: assembles it and makes the passes.
#include "pintle/simulate.h"

#include <fmt/format.h>

#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "pintle/bearings.h"
#include "run/check_settings.h"
#include "run/limits/limit_notes.h"
#include "run/limits/slow_motion_notes.h"
#include "run/limits/vacuum_notes.h"
#include "run/recorder.h"
#include "run/run_passes.h"
#include "start/start.h"

namespace pintle {
namespace {

constexpr std::size_t kManyBodies = 1000;  // with more bodies the assembly takes long enough to be reported

// What reading a file would have refused.
void check(const Model& model) {
  if (model.bodies.empty()) throw std::invalid_argument("the model has no body");
  if (model.space != "planar") throw std::invalid_argument(fmt::format("the model is \"{}\": only models of the plane are simulated", model.space));
  check_settings(model.simulate);
}

}  // namespace

Trajectory simulate_reduced(const Model& model, const RunShape& shape, const Observer& observer) {
  const Stopwatch clock;
  if (observer && model.bodies.size() > kManyBodies) observer({0, model.simulate.duration, 0, clock.seconds()});
  const Assembly start = start_of_run(model, shape.nominal != nullptr && !shape.checked ? shape.nominal->span : 0);
  Trajectory out;
  out.notes = model.notes;
  out.notes.insert(out.notes.end(), start.notes.begin(), start.notes.end());
  const std::unique_ptr<ForceRecorder> recorder = run_passes<Planar>(start.system, start.state, model.simulate, {[&] { return std::make_unique<Recorder>(model, start.system, shape.recorded); }, shape, observer, clock, &start.effective_mass}, out);
  if (shape.measured != nullptr && shape.checked) shape.measured->span = start.span;
  const std::unordered_set<std::string> not_unique(start.not_unique.begin(), start.not_unique.end());
  for (LoadSummary& joint : out.joints) joint.unique = !not_unique.contains(joint.name);
  if (shape.recorded == Recorded::kColumns) {
    out.bearings = bearing_summaries(model, out);
    std::vector<std::string> limits = limit_notes(start.system, start.state, model.simulate, out, *recorder);
    if (!limits.empty() && (out.outcome == Outcome::kEnergyOpen || out.outcome == Outcome::kFailed)) {  // the cause matters more than what the end looked like
      out.message = limits.front() + ". What followed: " + out.message;
      limits.erase(limits.begin());
    }
    out.notes.insert(out.notes.begin(), limits.begin(), limits.end());
    for (const std::vector<std::string>& notes : {vacuum_notes(model, out), slow_motion_notes(model, out)}) out.notes.insert(out.notes.end(), notes.begin(), notes.end());
  }
  out.wall_seconds = clock.seconds();
  return out;
}

Trajectory simulate(const Model& model, const Observer& observer) {
  check(model);
  return simulate_reduced(model, {}, observer);
}

}  // namespace pintle
