#include "start/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/absolute/radau_stepper.h"
#include "start/ideal_rows.h"
#include "start/slow_manifold.h"
#include "start/time_scales.h"
#include "start/tree_start.h"
#include "system/tree.h"

namespace pintle {
namespace {

constexpr double kScoutTolerance = 1e-3;
constexpr int kScoutSteps = 3;
constexpr int kSpans = 4;         // tried, each a quarter of the one before
constexpr double kSettled = 0.1;  // relative change of the gaps in the last sweep that is taken for convergence
constexpr double kMostGrowth = 2;  // of the largest joint force, by an attempt that has not converged
// Change of a body's speed, over the largest speed and over the largest rate of a gap: beyond both it is not the joints' giving way.
constexpr double kMostHaste = 1e-3, kMostLever = 30;
constexpr double kExact = 1e-6;   // the same, with nothing left to settle
constexpr double kEntirely = 0.99;  // of its slow motion: with this share a soft joint counts as going with the motion
constexpr const char* kNotSettled =
    "no transient-free start was found (a force jumps at the start, or a long chain has modes slower than its motion): joint forces may ring from the start. All passes start alike, so the stated "
    "errors do not include this";

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

double largest_gap_rate(const System& system, const State& state) {
  double largest = 0;
  for (std::size_t j = 0; j < state.gap_rate.size(); ++j)
    for (int k = 0; k < 2; ++k)
      if (system.joints[j].free_mask[k] == 0) largest = std::max(largest, std::abs(state.gap_rate[j][k]));
  return largest;
}

// In a chain of hundreds of joints, each of them fast, their compliances add up to modes slower than the motion. What the sweeps
// then approach is not where it starts: all joints give way a little, one after the other, and the ends get speeds of their own.
bool is_runaway(const System& system, const State& attempt, const State& given) {
  Vecs change = attempt.v;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= given.v[i];
  return system.largest_speed(change) > std::max(kMostHaste * system.largest_speed(given.v), kMostLever * largest_gap_rate(system, attempt));
}

// Whether sweeps that have not converged came near. Forces far above those of the given state are no attempt at all.
bool is_near(const State& attempt, const State& given) { return largest_force(attempt.force) <= kMostGrowth * largest_force(given.force); }

// Fast joints ride their slow motion; where that is not found the state stays, or with `keep_best` is the best attempt. Over which
// time it was found; 0: it was not.
double settle_fast_joints(const System& system, const TimeScales& time_scales, double span, bool keep_best, State& state) {
  const State given = state;
  for (int i = 0; i < kSpans && span > 0; ++i, span *= 0.25) {
    State attempt = state;
    const double change = move_onto_slow_manifold(system, time_scales, span, attempt);
    if (is_runaway(system, attempt, given)) continue;
    if (change < kSettled || (keep_best && is_near(attempt, given))) state = std::move(attempt);
    if (change < kSettled) return span;
  }
  return 0;
}

// Says which joints start on a motion of their own. True when there are none.
bool note_resolved_joints(const System& system, const TimeScales& time_scales, const SoftStart& soft, std::vector<std::string>& notes) {
  bool none = true;
  for (std::size_t j = 0; j < soft.share.size(); ++j) {
    Eigen::Index slowest = 0;
    const double share = soft.share[j].minCoeff(&slowest);
    if (share > kEntirely) continue;
    none = false;
    notes.push_back(fmt::format("{} {}: with a rate of {:.3g} 1/s it relaxes more slowly than its load varies; it starts at the deflection that carries the load, "
                                "with {:.0f} % of the quasi-static rate, and its transient is part of the solution",
                                system.joints[j].servo < 0 ? "joint" : "motor", system.joints[j].name, time_scales.slow_rate[j][slowest], 100 * share));
  }
  return none;
}

// theory/assembly section 5: soft joints first, then the others around them.
void settle_soft_joints(const System& system, const TimeScales& time_scales, double span, Assembly& assembly) {
  State attempt = assembly.state;
  const SoftStart soft = place_soft_joints(system, time_scales, 2 * span, attempt);
  if (soft.change < kSettled || is_near(attempt, assembly.state)) assembly.state = std::move(attempt);
  const bool along = note_resolved_joints(system, time_scales, soft, assembly.notes);
  if (soft.placed && along && soft.change < kExact) return;
  if (settle_fast_joints(system, time_scales, span, false, assembly.state) > 0) return;
  if (!soft.placed || soft.change >= kSettled) assembly.notes.push_back(kNotSettled);
}

void settle_joints(const System& system, double duration, double known_span, Assembly& assembly) {
  if (!(duration > 0)) return;
  State& state = assembly.state;
  const double span = known_span > 0 ? known_span : span_of_motion(system, state, 4 * duration);
  assembly.span = span;
  const TimeScales time_scales = measure_time_scales(system, state, span);
  if (span > 0 && time_scales.any_soft()) return settle_soft_joints(system, time_scales, span, assembly);
  assembly.settled_over = settle_fast_joints(system, all_fast(system), smooth_span(system, state, duration), true, state);
  if (assembly.settled_over == 0) assembly.notes.push_back(kNotSettled);
}

Assembly start_of_free_bodies(const Model& model, System& system, double known_span) {
  Assembly assembly = assemble(model, system);
  if (model.simulate.start != Start::kAssembled || system.joints.empty()) return assembly;
  settle_joints(system, model.simulate.duration, known_span, assembly);
  return assembly;
}

// Equations that keep a gap at zero do not ask the joint's law, and so do not know of its friction either.
template <class IsIdeal>
void note_lost_friction(const System& system, const IsIdeal& is_ideal, std::vector<std::string>& notes) {
  for (int j = 0; j < system.n_joints(); ++j)
    if (is_ideal(j) && system.joints[j].law.rubs()) notes.push_back(fmt::format("joint {} is ideal: its friction is not in these equations", system.joints[j].name));
}

}  // namespace

Assembly start_of_run(const Model& model, System& system, double known_span) {
  if (model.simulate.equations == Equations::kIdeal) {
    Assembly assembly = ideal_start(model, system);
    note_lost_friction(system, [&system](int j) { return system.joints[j].ideal; }, assembly.notes);
    return assembly;
  }
  if (model.simulate.equations != Equations::kRelative) return start_of_free_bodies(model, system, known_span);
  const JointTree tree(system);
  Assembly assembly = tree.all_free() ? start_of_free_bodies(model, system, known_span) : start_over_tree(model, system);
  for (std::string& line : tree.notes()) assembly.notes.push_back(std::move(line));
  note_lost_friction(system, [&tree](int j) { return tree.in_tree(j); }, assembly.notes);
  return assembly;
}

}  // namespace pintle
