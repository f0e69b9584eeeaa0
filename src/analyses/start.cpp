#include "analyses/start.h"

#include <utility>

#include "analyses/ideal_rows.h"
#include "analyses/slow_motion.h"
#include "integrators/radau_stepper.h"

namespace pintle {
namespace {

constexpr double kScoutTolerance = 1e-3;
constexpr int kScoutSteps = 3;
constexpr int kSpans = 4;         // tried, each a quarter of the one before
constexpr double kSettled = 0.1;  // relative change of the gaps in the last sweep that is taken for convergence

// A step that a rough integration takes, once it is under way: the gaps are smooth over about that time.
double natural_step(const System& system, const State& start, double duration) {
  RadauStepper scout(system, kScoutTolerance);
  scout.start(start, 1e-3 * duration);
  for (int i = 0; i < kScoutSteps; ++i)
    if (!scout.step(duration)) return 0;
  return scout.state().t - scout.previous().t;
}

// Ideal joints carry no preload: the loops are closed as they are.
Assembly ideal_start(Model model, System& system) {
  if (model.simulate.start == Start::kAssembled) model.simulate.start = Start::kUnloaded;
  Assembly assembly = assemble(model, system);
  make_ideal(system);
  IdealRows rows = choose_ideal_rows(system, assembly.state.q);
  assembly.notes.insert(assembly.notes.end(), rows.notes.begin(), rows.notes.end());
  assembly.not_unique = std::move(rows.not_unique);
  return assembly;
}

}  // namespace

Assembly start_of_run(const Model& model, System& system) {
  if (model.simulate.equations == Equations::kIdeal) return ideal_start(model, system);
  Assembly assembly = assemble(model, system);
  if (model.simulate.start != Start::kAssembled || system.joints.empty()) return assembly;
  double span = 0.5 * natural_step(system, assembly.state, model.simulate.duration);
  for (int i = 0; i < kSpans && span > 0; ++i, span *= 0.25)
    if (settle_on_slow_motion(system, span, assembly.state) < kSettled) break;
  return assembly;
}

}  // namespace pintle
