#include "analyses/start.h"

#include <cmath>
#include <utility>

#include "analyses/ideal_rows.h"
#include "analyses/joint_paces.h"
#include "analyses/slow_motion.h"
#include "analyses/tree_start.h"
#include "integrators/radau_stepper.h"
#include "system/tree.h"

namespace pintle {
namespace {

constexpr double kScoutTolerance = 1e-3;
constexpr int kScoutSteps = 3;
constexpr int kSpans = 4;         // tried, each a quarter of the one before
constexpr double kSettled = 0.1;  // relative change of the gaps in the last sweep that is taken for convergence

// Half a step that a rough integration takes, once it is under way: the gaps are smooth over about that time. Rounded to a
// part of the duration, so that it does not change with every slight change of the model: where a joint is as slow as the
// motion, what is called its slow motion depends on the span.
double smooth_span(const System& system, const State& start, double duration) {
  RadauStepper scout(system, kScoutTolerance);
  scout.start(start, 1e-3 * duration);
  for (int i = 0; i < kScoutSteps; ++i)
    if (!scout.step(duration)) return 0;
  const double half = 0.5 * (scout.state().t - scout.previous().t);
  return half > 0 ? duration * std::exp2(std::floor(std::log2(half / duration))) : 0;
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

Assembly start_of_free_bodies(const Model& model, System& system) {
  Assembly assembly = assemble(model, system);
  if (model.simulate.start != Start::kAssembled || system.joints.empty()) return assembly;
  double span = span_of_motion(system, assembly.state, 4 * model.simulate.duration);
  if (std::getenv("PSPAN")) span *= std::atof(std::getenv("PSPAN"));
  const JointPaces paces = measure_paces(system, assembly.state, span);
  if (std::getenv("PSPAN")) std::fprintf(stderr, "motion span %g scout %g\n", span, smooth_span(system, assembly.state, model.simulate.duration));
  if (std::getenv("PSPAN")) for (int j = 0; j < system.n_joints(); ++j) std::fprintf(stderr, "  %s creeping %g %g %g lively %g %g %g slow %g %g %g\n", system.joints[j].name.c_str(), paces.creeping[j][0], paces.creeping[j][1], paces.creeping[j][2], paces.lively[j][0], paces.lively[j][1], paces.lively[j][2], paces.slow_rate[j][0], paces.slow_rate[j][1], paces.slow_rate[j][2]);
  if (paces.any_soft()) place_soft_joints(system, paces, 2 * span, assembly.state);
  if (!paces.any_soft()) span = smooth_span(system, assembly.state, model.simulate.duration);
  for (int i = 0; i < kSpans; ++i, span *= 0.25) {
    State settled = assembly.state;
    const double change = settle_on_slow_motion(system, paces, span, settled);
    if (std::getenv("PSPAN")) std::fprintf(stderr, "span %g change %g soft %d\n", span, change, paces.any_soft());
    if (!paces.any_soft() || change < kSettled) assembly.state = std::move(settled);
    if (change < kSettled) break;
  }
  return assembly;
}

}  // namespace

Assembly start_of_run(const Model& model, System& system) {
  if (model.simulate.equations == Equations::kIdeal) return ideal_start(model, system);
  if (model.simulate.equations != Equations::kLagrangian) return start_of_free_bodies(model, system);
  const JointTree tree(system);
  Assembly assembly = tree.all_free() ? start_of_free_bodies(model, system) : start_over_tree(model, system);
  for (std::string& line : tree.notes()) assembly.notes.push_back(std::move(line));
  return assembly;
}

}  // namespace pintle
