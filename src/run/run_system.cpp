#include "run/run_system.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "run/check_settings.h"
#include "run/run_passes.h"

namespace pintle {
namespace {

void demand(bool good, const std::string& complaint) {
  if (!good) throw std::invalid_argument(complaint);
}

template <class S>
void check(const BasicSystem<S>& system, const BasicState<S>& start) {
  const std::size_t bodies = system.bodies.size(), joints = system.joints.size();
  demand(start.q.size() == bodies && start.v.size() == bodies,
         fmt::format("the start has places of {} and velocities of {} bodies, the system {} bodies: give one of each for every body", start.q.size(), start.v.size(), bodies));
  demand(start.a.size() == bodies && start.gap.size() == joints && start.gap_rate.size() == joints && start.gap_accel.size() == joints && start.force.size() == joints &&
             start.law_state.size() == static_cast<std::size_t>(system.n_law_states()) && start.law_rate.size() == start.law_state.size(),
         "the start has no accelerations, gaps or forces that go with its places and velocities: call start_forces (start/start.h) before the run");
  demand(start.t == 0, fmt::format("the start is at t = {} s: a run begins at 0", start.t));
  demand(is_finite(start), "the start has components that are not numbers: check places, velocities, masses and laws");
}

}  // namespace

template <class S>
BasicSystemRun<S> run_system(const BasicSystem<S>& system, const BasicState<S>& start, const SimulateSettings& settings, const Observer& observer) {
  check_settings(settings);
  check(system, start);
  const Stopwatch clock;
  BasicSystemRun<S> out;
  const auto recorder = run_passes<S>(system, start, settings, {[&] { return std::make_unique<BasicForceRecorder<S>>(system, Recorded::kStates); }, {}, observer, clock}, out.result);
  out.rows = recorder->take_forces();
  out.result.wall_seconds = clock.seconds();
  return out;
}

template SystemRun run_system(const System& system, const State& start, const SimulateSettings& settings, const Observer& observer);
PINTLE_IN_SPACE(template BasicSystemRun<Spatial> run_system(const BasicSystem<Spatial>& system, const BasicState<Spatial>& start, const SimulateSettings& settings, const Observer& observer);)

}  // namespace pintle
